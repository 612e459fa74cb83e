"""Errors of calibration routines.

RoutineError
├── RoutineRunningError      one is under way already
├── NoRoutineError           there is none to go on with, or to end
├── NoQuestionError          nothing, or something else, is asked
├── AnswerUnfitError         the number is missing, or cannot be right
├── RoutineLostError         PlugPilot ended in the middle of it
├── SlideHitError            something stands where the slide should run freely
├── NoSpringError            nothing gave way as a spring does
├── LabelMovedError          the label is not where it was when the routine began
├── LabelLostError           too few places show the label
├── BoardBlurredError        the calibration board is not sharp, though it stands still
├── TooFewViewsError         nothing new came for long, and there are too few views
├── PlugNotInError           the socket cannot be taught without the plug in it
├── AxesSwappedError         the carriages answer for each other
└── MotorReversedError       a carriage runs the wrong way
"""

from __future__ import annotations

from server.errors import PlugPilotError


class RoutineError(PlugPilotError):
    """A calibration routine cannot go on."""

    code = "calibration_routine"
    title = "The calibration cannot go on"
    status = 409


class RoutineRunningError(RoutineError):
    """One is under way already."""

    code = "calibration_running"
    title = "A calibration is under way"
    remedy = "Wait until it has ended, or end it."


class NoRoutineError(RoutineError):
    """There is none to go on with, or to end."""

    code = "calibration_none"
    title = "No calibration is under way"
    remedy = "Begin one."


class NoQuestionError(RoutineError):
    """Nothing, or something else, is asked."""

    code = "calibration_no_question"
    title = "The calibration asks nothing like that"
    remedy = "Look at what it asks now."


class AnswerUnfitError(RoutineError):
    """The number is missing, or cannot be right."""

    code = "calibration_answer"
    title = "This number cannot be right"
    status = 422
    remedy = "Measure again, and enter the number in the unit that is shown."


class RoutineLostError(RoutineError):
    """PlugPilot ended in the middle of it."""

    code = "calibration_lost"
    title = "PlugPilot was restarted in the middle of the calibration"
    remedy = "Nothing has changed. Begin the calibration again."


class SlideHitError(RoutineError):
    """Something stands where the slide should run freely."""

    code = "calibration_slide_hit"
    title = "The plug has met something"
    remedy = "Clear the way before the plug, or choose a shorter stroke, then go on."


class NoSpringError(RoutineError):
    """Nothing gave way as a spring does."""

    code = "calibration_no_spring"
    title = "The plug has met no spring"
    remedy = "Put the spring straight before the plug, within its reach, then go on."


class LabelMovedError(RoutineError):
    """The label is not where it was when the routine began."""

    code = "calibration_label_moved"
    title = "The label has moved during the calibration"
    remedy = "Fix the label and the car so that nothing moves, then begin again."


class LabelLostError(RoutineError):
    """Too few places show the label."""

    code = "calibration_label_lost"
    title = "The label was seen too seldom"
    remedy = "Look for glare, dirt and things in front of the label, then go on."


class BoardBlurredError(RoutineError):
    """The calibration board is not sharp, though it stands still."""

    code = "calibration_board_blurred"
    title = "The board is blurred"
    remedy = "Clean the lens, set its focus to where labels are, give it more light, then go on."


class TooFewViewsError(RoutineError):
    """Nothing new came for long, and there are too few views."""

    code = "calibration_too_few_views"
    title = "There are too few views of the board"
    remedy = "Go on, and hold the board as the page says, still for a second each time."


class PlugNotInError(RoutineError):
    """The socket cannot be taught without the plug in it."""

    code = "calibration_plug_not_in"
    title = "The plug is not in the socket"
    remedy = "Jog the plug all the way into the socket first."


class AxesSwappedError(RoutineError):
    """The carriages answer for each other."""

    code = "calibration_axes_swapped"
    title = "The two carriages are swapped"
    remedy = "Swap the plugs of the two carriage motors at the board, home the robot, begin again."


class MotorReversedError(RoutineError):
    """A carriage runs the wrong way."""

    code = "calibration_motor_reversed"
    title = "A carriage runs the wrong way"
    remedy = "Turn the motor's direction round in the board's settings, home, begin again."
