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
