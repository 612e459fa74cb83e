"""What can be wrong with a label."""

from __future__ import annotations

from server.errors import PlugPilotError


class LabelError(PlugPilotError):
    """A label cannot be made or cannot be trusted."""

    code = "label"
    title = "The label does not fit"
    status = 422


class LabelNameError(LabelError):
    """This name cannot stand in a label."""

    code = "label_name"
    title = "This vehicle cannot have a label"
    remedy = "Use 1 to 64 letters, digits, dots, hyphens and underscores; begin with a letter."


class LabelSizeError(LabelError):
    """The label does not fit onto the paper, or cannot be seen."""

    code = "label_size"
    title = "The label has an impossible size"
    remedy = "Choose a size between 30 and 120 mm; 60 mm is right for most cars."


class ForeignTextError(LabelError):
    """This is some other QR code."""

    code = "label_foreign_text"
    title = "This is not a label of PlugPilot"
    remedy = "Print a label with `plugpilot label` and stick it beside the socket."


class OldLabelError(LabelError):
    """A label of a format that is not in use any more, or not yet."""

    code = "label_version"
    title = "The label has another format"
    remedy = "Print the label anew with this version of PlugPilot."


class DamagedTextError(LabelError):
    """The check value does not fit: the text was changed or typed wrongly."""

    code = "label_check"
    title = "The text of the label is damaged"
    remedy = "Print the label anew."


class ForeignLabelError(LabelError):
    """The signature is not ours: somebody else made this label."""

    code = "label_foreign"
    title = "The label was made for another robot"
    remedy = "Print a label with this robot's key, or copy the key of the robot that printed it."


class LabelKeyError(LabelError):
    """The key of the installation cannot be used."""

    code = "label_key"
    title = "The key for labels cannot be used"
    status = 500
    remedy = (
        "Make the file readable for PlugPilot only (chmod 600). A lost key is made anew when the "
        "file is gone; labels printed before must then be printed again."
    )


class SheetError(LabelError):
    """The sheet cannot be written."""

    code = "label_sheet"
    title = "The sheet cannot be written"
    remedy = "Name a file that ends in .pdf, .svg or .png, in a folder that can be written to."
