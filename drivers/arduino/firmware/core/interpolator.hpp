// Follows segments: the step interrupt's side of the motion, and the queue in front of it.
//
// tick() belongs to the step interrupt, everything else to the main loop, which locks the interrupt
// out while it touches what both use.
#pragma once
#include <stdint.h>

#include "critical_section.hpp"
#include "rail_axis.hpp"
#include "segment.hpp"
#include "switch_watch.hpp"
#include "tick_clock.hpp"

namespace plugpilot {

constexpr uint8_t kQueueCapacity = protocol::QUEUE_CAPACITY;
constexpr uint16_t kCoastTicks = 0xFFFF;  // 3.3 s: longer than the watchdog lets it last

// What a tick asks of the pins: bit `axis` for a step, bit `axis + kBackwardsShift` for direction.
constexpr uint8_t kBackwardsShift = 4;

// The set points of one instant.
struct SetPoint {
  uint32_t tick;
  int32_t rail_position[kRails];
  int64_t slide_position;
  int32_t rate[kAxes];
  bool in_host_segment;
  uint8_t queue_used;       // the one that is being followed included
  uint16_t segment_number;  // of the host's segment that is being followed
  uint16_t segment_tick;    // ticks of it that are done
};

class Interpolator {
 public:
  // --- the step interrupt ---

  // A watched switch ends the steps at once, without deceleration, and drops the queue; the main
  // loop finds that in switches() and must settle().
  //
  // end_segment(interpolator) has to call end_segment(). It is given from outside because a plain
  // call would make the interrupt save all registers at every tick, though it is rarely made.
  template <class EndSegment>
  inline __attribute__((always_inline)) uint8_t tick(uint8_t switch_levels, EndSegment end) {
    clock_.advance_by_one_tick();
    if (ticks_left_ == 0) return 0;
    if (switches_.trips(switch_levels)) {
      end(*this);
      return 0;
    }
    uint8_t pins = 0;
    const RailTick rho1 = advance_by_one_tick(rails_[0]);
    if (rho1.step & kTopBit) pins |= 1;
    if (rho1.backwards & kTopBit) pins |= 1 << kBackwardsShift;
    const RailTick rho2 = advance_by_one_tick(rails_[1]);
    if (rho2.step & kTopBit) pins |= 2;
    if (rho2.backwards & kTopBit) pins |= 2 << kBackwardsShift;
    if (--ticks_left_ == 0) end(*this);
    return pins;
  }

  uint8_t tick(uint8_t switch_levels) {
    return tick(switch_levels, [](Interpolator& self) { self.end_segment(); });
  }

  // The segment is over, or a switch has tripped.
  void end_segment();

  // --- the main loop ---

  const TickClock& clock() const { return clock_; }
  SwitchWatch& switches() { return switches_; }

  // Something moves, or waits in the queue until release().
  bool running() const;

  // Steps end at once, as a switch ends them.
  void halt();

  uint8_t used() const { return static_cast<uint8_t>(head_ - tail_); }
  uint8_t free_places() const { return static_cast<uint8_t>(kQueueCapacity - used()); }

  // Between these two, segments are pushed without being begun. A stop releases, too.
  void hold() { held_ = true; }
  void release();
  bool held() const { return held_; }

  // Where and how fast the next segment must begin.
  const QueueEnd& end() const { return end_; }

  // At rest: go on from these parts of a unit, which no step counter can tell apart.
  void take_over_phases(const uint32_t (&phase)[kAxes]);

  // Put a segment behind the others; slide_start is filled in. The caller has checked it: there is
  // a free place and its rates stay within 32 bits. False if the queue has just run empty in
  // motion: the axes are about to brake.
  //
  // reached: end() with the segment appended. ends_at_rest: nothing needs to follow. Otherwise the
  // axes go on at their last rates if nothing does, and ran_empty() becomes true.
  bool push(const Segment& segment, const QueueEnd& reached, bool ends_at_rest);

  // Nothing needs to follow what is in the queue.
  bool ends_at_rest() const { return rests_behind_queue_; }

  // The queue ran empty while something still moved; it goes on unbraked. Call brake().
  bool ran_empty() const { return ran_empty_; }

  // How fast each axis may come to rest [2^-31 units per tick^2, above 0].
  void set_deceleration(const int32_t (&deceleration)[kAxes]);

  // Drop the queue and bring all axes to rest together, none with more than its deceleration.
  void brake() { brake_from(nullptr); }

  // The same, but the slide's set point jumps to a position [counts] and stays there.
  void brake_and_hold_slide(int32_t slide_counts) { brake_from(&slide_counts); }

  // At rest after a stop: the chain begins afresh where the rails are, and with the slide's set
  // point at its measured position [counts].
  void settle(int32_t slide_counts);

  // At rest: give the axes other coordinates [units]; nothing moves.
  void renumber(const int32_t (&position)[kAxes]);

  SetPoint set_point() const;

  // What the step counter does not show [2^-31 steps].
  uint32_t rail_phase(uint8_t axis) const { return rails_[axis].phase; }

 private:
  void take_next();
  void begin(const Segment* segment);
  void rest();
  void brake_from(const int32_t* slide_counts);
  uint16_t braking_ticks(const Segment& coast) const;
  bool hold_rates(Segment& coast);
  int64_t resting_slide() const;
  void finish_brake(const Segment& coast, uint16_t ticks);

  TickClock clock_;
  SwitchWatch switches_;
  RailAxis rails_[kRails] = {{kHalfUnit, 0, 0, 0}, {kHalfUnit, 0, 0, 0}};
  uint16_t ticks_left_ = 0;
  volatile uint8_t head_ = 0;  // both run freely; their low bits are places in the queue
  volatile uint8_t tail_ = 0;
  volatile bool ran_empty_ = false;
  bool rests_behind_queue_ = true;
  volatile bool held_ = false;
  const Segment* current_ = nullptr;
  const Segment* behind_queue_ = nullptr;  // followed when the queue runs empty in motion
  Segment queue_[kQueueCapacity] = {};
  Segment coast_[2] = {};  // one in use, one to prepare
  Segment brake_ = {};
  QueueEnd end_ = {{kHalfUnit, kHalfUnit, kHalfUnit}, {0, 0, 0}};
  int32_t deceleration_[kAxes] = {1, 1, 1};
};

}  // namespace plugpilot
