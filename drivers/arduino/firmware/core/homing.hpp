// How the board finds its limit switches.
//
// The slide goes first, so that the plug is drawn back before anything moves sideways. With both
// carriages at the start of their strokes the legs could not close, so while one carriage seeks its
// switch the other runs away at the same speed: the platform moves along the rail at constant
// height. That height is chosen beforehand, by bringing rho1 + rho2 to carriage_sum. Homing ends in
// the rest position, the carriages first.
#pragma once
#include "configuration.hpp"
#include "encoder.hpp"
#include "interpolator.hpp"
#include "trapezoid.hpp"

namespace plugpilot {

class Homing {
 public:
  enum class Result : uint8_t { RUNNING, DONE, FAILED };

  Homing(Interpolator& interpolator, Encoder& encoder, const Configuration& config)
      : interpolator_(interpolator), encoder_(encoder), config_(config) {}

  void begin();

  // One millisecond.
  //
  // Args: bits of the axes whose switches are pressed; whether the slide has arrived at its set
  // point.
  Result step(uint8_t pressed, bool slide_arrived);

  // The axis whose switch was sought last, for the words about a failure.
  uint8_t axis() const { return axis_; }

 private:
  enum class Phase : uint8_t {
    SEEK,          // towards the switch, fast
    SEEK_BRAKE,    // it was found
    LEAVE,         // away until it opens
    LEAVE_BRAKE,   // it is open
    BACK_OFF,      // a little further
    LOCATE,        // towards it again, slowly
    LOCATE_BRAKE,  // this is its place
    CHOOSE_HEIGHT,
    RAILS_TO_REST,
    SLIDE_TO_REST,
  };

  Result next(Phase phase);
  Result after_brake();
  Result after_locating();
  Result found_or_failed(bool at_rest, bool pressed, Phase brake);
  bool start(Phase phase);
  bool move(const Trapezoid& motion);
  bool seek(uint32_t rate, uint32_t units, int8_t direction);
  bool choose_height();
  bool rails_to_rest();
  bool slide_to_rest();
  bool move_rails(int32_t rho1, int32_t rho2);
  void take_place();
  int32_t position(uint8_t axis) const;

  Interpolator& interpolator_;
  Encoder& encoder_;
  const Configuration& config_;
  TrapezoidPlan plan_;
  Phase phase_ = Phase::SEEK;
  uint8_t axis_ = kSlide;
  int32_t found_at_ = 0;  // where the switch closed
};

}  // namespace plugpilot
