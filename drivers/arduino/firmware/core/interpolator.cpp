#include "interpolator.hpp"

namespace plugpilot {
namespace {

int32_t magnitude(int32_t value) { return value < 0 ? -value : value; }

}  // namespace

// --- the step interrupt, or the main loop with the interrupt locked out ---

void Interpolator::begin(const Segment* segment) {
  current_ = segment;
  for (uint8_t axis = 0; axis < kRails; ++axis) {
    rails_[axis].rate = segment->rate[axis];
    rails_[axis].acceleration = segment->acceleration[axis];
  }
  ticks_left_ = segment->ticks;
}

void Interpolator::rest() {
  ticks_left_ = 0;
  current_ = nullptr;
  tail_ = head_;
  rests_behind_queue_ = true;
  ran_empty_ = false;
  held_ = false;
}

void Interpolator::end_segment() {
  if (switches_.has_tripped()) {
    rest();
  } else {
    take_next();
  }
}

void Interpolator::take_next() {
  if (head_ != tail_) tail_ = tail_ + 1;
  if (head_ != tail_) {
    begin(&queue_[tail_ % kQueueCapacity]);
  } else if (rests_behind_queue_) {
    rest();
  } else {
    rests_behind_queue_ = true;
    ran_empty_ = true;
    begin(behind_queue_);
  }
}

// --- the main loop ---

bool Interpolator::running() const {
  CriticalSection lock;
  return ticks_left_ != 0 || head_ != tail_;
}

void Interpolator::halt() {
  CriticalSection lock;
  rest();
}

void Interpolator::take_over_phases(const uint32_t (&phase)[kAxes]) {
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    end_.position[axis] = end_.position[axis] - phase_part(end_.position[axis]) + phase[axis];
  }
  CriticalSection lock;
  for (uint8_t axis = 0; axis < kRails; ++axis) rails_[axis].phase = phase[axis];
}

bool Interpolator::push(const Segment& segment, const QueueEnd& reached, bool ends_at_rest) {
  Segment& place = queue_[head_ % kQueueCapacity];
  place = segment;
  place.slide_start = end_.position[kSlide];
  Segment& coast = behind_queue_ == &coast_[0] ? coast_[1] : coast_[0];
  coast = place;
  coast.from_host = false;
  coast.ticks = kCoastTicks;
  coast.slide_start = reached.position[kSlide];
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    coast.rate[axis] = reached.rate[axis];
    coast.acceleration[axis] = 0;
  }
  {
    CriticalSection lock;
    if (ran_empty_) return false;
    behind_queue_ = &coast;
    rests_behind_queue_ = ends_at_rest;
    head_ = head_ + 1;
    if (ticks_left_ == 0 && !held_) begin(&place);
  }
  end_ = reached;
  for (uint8_t axis = 0; ends_at_rest && axis < kAxes; ++axis) end_.rate[axis] = 0;
  return true;
}

void Interpolator::set_deceleration(const int32_t (&deceleration)[kAxes]) {
  for (uint8_t axis = 0; axis < kAxes; ++axis) deceleration_[axis] = deceleration[axis];
}

// In so many ticks the slowest axis comes to rest; 0 at rest.
uint16_t Interpolator::braking_ticks(const Segment& coast) const {
  int32_t ticks = 0;
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    if (coast.rate[axis] == 0) continue;
    const int32_t rounded_up = magnitude(coast.rate[axis]) / deceleration_[axis] + 1;
    if (rounded_up > ticks) ticks = rounded_up;
  }
  return ticks < kCoastTicks ? static_cast<uint16_t>(ticks) : kCoastTicks;
}

void Interpolator::release() {
  CriticalSection lock;
  held_ = false;
  if (ticks_left_ == 0 && head_ != tail_) begin(&queue_[tail_ % kQueueCapacity]);
}

// Dividing takes longer than a tick, so the rates are held until the brake has been worked out.
void Interpolator::brake_from(const int32_t* slide_counts) {
  Segment coast = {};
  if (!hold_rates(coast)) {
    end_.position[kSlide] = slide_counts != nullptr ? centred(*slide_counts) : resting_slide();
    halt();  // what waits in the queue is dropped, too
    return;
  }
  if (slide_counts != nullptr) {
    coast.slide_start = centred(*slide_counts);
    coast.rate[kSlide] = 0;
  }
  finish_brake(coast, braking_ticks(coast));
}

bool Interpolator::hold_rates(Segment& coast) {
  const Segment* left;
  uint16_t ticks_done;
  Segment& held = behind_queue_ == &coast_[0] ? coast_[1] : coast_[0];
  {
    CriticalSection lock;
    if (ticks_left_ == 0) return false;
    left = current_;
    ticks_done = static_cast<uint16_t>(left->ticks - ticks_left_);
    for (uint8_t axis = 0; axis < kRails; ++axis) {
      held.rate[axis] = rails_[axis].rate;
      held.acceleration[axis] = 0;
    }
    held.ticks = kCoastTicks;
    held.from_host = false;
    rest();
    behind_queue_ = &held;
    begin(&held);
  }
  // `left` is a place of the queue or the other coast: nobody writes there before this returns
  const int32_t rate = left->rate[kSlide];
  const int32_t acceleration = left->acceleration[kSlide];
  held.rate[kSlide] = rate_within_range(rate, acceleration, ticks_done);
  held.acceleration[kSlide] = 0;
  held.slide_start = position_after(left->slide_start, rate, acceleration, ticks_done);
  coast = held;
  return true;
}

void Interpolator::finish_brake(const Segment& coast, uint16_t ticks) {
  brake_ = coast;
  brake_.ticks = ticks;
  for (uint8_t axis = 0; ticks != 0 && axis < kAxes; ++axis) {
    brake_.acceleration[axis] = -(coast.rate[axis] / ticks);
  }
  uint16_t coasted_ticks;
  {
    CriticalSection lock;
    coasted_ticks = static_cast<uint16_t>(kCoastTicks - ticks_left_);
    if (ticks == 0) {
      rest();
    } else {
      begin(&brake_);
    }
  }
  brake_.slide_start = position_after(coast.slide_start, coast.rate[kSlide], 0, coasted_ticks);
  end_.position[kSlide] = position_after(brake_.slide_start, brake_.rate[kSlide],
                                         brake_.acceleration[kSlide], ticks);
}

void Interpolator::settle(int32_t slide_counts) {
  const SetPoint here = set_point();
  const int32_t position[kAxes] = {here.rail_position[0], here.rail_position[1], slide_counts};
  renumber(position);
}

void Interpolator::renumber(const int32_t (&position)[kAxes]) {
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    end_.position[axis] = centred(position[axis]);
    end_.rate[axis] = 0;
  }
  CriticalSection lock;
  for (uint8_t axis = 0; axis < kRails; ++axis) {
    rails_[axis] = RailAxis{kHalfUnit, 0, 0, position[axis]};
  }
}

// While nothing is followed: where the slide's set point stands.
int64_t Interpolator::resting_slide() const {
  return head_ == tail_ ? end_.position[kSlide] : queue_[tail_ % kQueueCapacity].slide_start;
}

SetPoint Interpolator::set_point() const {
  SetPoint now = {};
  const Segment* segment;
  uint16_t ticks_done = 0;
  TickClock time;
  {
    CriticalSection lock;
    time = clock_;
    now.queue_used = used();
    segment = current_;
    for (uint8_t axis = 0; axis < kRails; ++axis) now.rail_position[axis] = rails_[axis].position;
    if (segment != nullptr) {
      ticks_done = static_cast<uint16_t>(segment->ticks - ticks_left_);
      for (uint8_t axis = 0; axis < kRails; ++axis) now.rate[axis] = rails_[axis].rate;
    }
  }
  now.tick = time.ticks();
  if (segment == nullptr) {
    now.slide_position = resting_slide();
    if (now.queue_used == 0) return now;
    const Segment& first = queue_[tail_ % kQueueCapacity];  // held: none of its ticks is done
    now.in_host_segment = first.from_host;
    now.segment_number = first.number;
    return now;
  }
  const int32_t rate = segment->rate[kSlide];
  const int32_t acceleration = segment->acceleration[kSlide];
  now.slide_position = position_after(segment->slide_start, rate, acceleration, ticks_done);
  now.rate[kSlide] = rate_within_range(rate, acceleration, ticks_done);
  now.in_host_segment = segment->from_host;
  now.segment_number = segment->number;
  now.segment_tick = ticks_done;
  return now;
}

}  // namespace plugpilot
