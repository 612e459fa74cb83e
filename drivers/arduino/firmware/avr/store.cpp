#include "store.hpp"

#include <avr/eeprom.h>
#include <string.h>

#include "../core/kept_configuration.hpp"
#include "../core/place_record.hpp"

namespace plugpilot {
namespace store {
namespace {

struct Layout {
  uint16_t boots;
  uint8_t fault;
  uint8_t unused[5];
  PlaceRecord places[kPlaceRecords];
  KeptConfiguration kept;
};
static_assert(sizeof(Layout) <= 4096, "more than the EEPROM holds");

Layout EEMEM eeprom;

// Bytes on their way into the EEPROM.
template <uint16_t Size>
struct Job {
  uint8_t bytes[Size];
  uint8_t* to;
  uint16_t done = Size;

  void begin(void* address, const void* from) {
    memcpy(bytes, from, Size);
    to = static_cast<uint8_t*>(address);
    done = 0;
  }
  bool step() {
    if (done == Size) return false;
    eeprom_update_byte(to + done, bytes[done]);
    ++done;
    return true;
  }
};

Job<1> fault_job;
Job<sizeof(PlaceRecord)> place_job;
Job<sizeof(KeptConfiguration)> configuration_job;
PlaceRecord newest = {};
uint8_t newest_slot = kPlaceRecords - 1;

}  // namespace

Kept load_configuration(Configuration& configuration) {
  KeptConfiguration kept;
  eeprom_read_block(&kept, &eeprom.kept, sizeof kept);
  configuration = kept.configuration;
  if (kept.is_of_this_protocol() && kept.is_whole()) return Kept::WHOLE;
  // the CRC tells a configuration of another version from a damaged one
  const bool another = !kept.is_of_this_protocol() && kept.crc == kept.configuration.crc();
  return another || kept.is_blank() ? Kept::NOTHING : Kept::DAMAGED;
}

protocol::Fault load_fault() {
  const uint8_t code = eeprom_read_byte(&eeprom.fault);
  // an EEPROM that was never written reads 0xFF
  return code > static_cast<uint8_t>(protocol::Fault::WATCHDOG) ? protocol::Fault::NONE
                                                                : static_cast<protocol::Fault>(code);
}

bool load_place(int32_t (&position)[protocol::AXES]) {
  bool found = false;
  for (uint8_t slot = 0; slot < kPlaceRecords; ++slot) {
    PlaceRecord record;
    eeprom_read_block(&record, &eeprom.places[slot], sizeof record);
    if (!record.is_whole() || (found && !record.is_newer_than(newest))) continue;
    newest = record;
    newest_slot = slot;
    found = true;
  }
  if (found) memcpy(position, newest.position, sizeof position);
  return found;
}

uint16_t count_boot() {
  const uint16_t boots = static_cast<uint16_t>(eeprom_read_word(&eeprom.boots) + 1);
  eeprom_update_word(&eeprom.boots, boots);
  return boots;
}

void save_configuration(const Configuration& configuration) {
  const KeptConfiguration kept = KeptConfiguration::of(configuration);
  configuration_job.begin(&eeprom.kept, &kept);
}

void save_fault(protocol::Fault fault) { fault_job.begin(&eeprom.fault, &fault); }

void save_place(const int32_t (&position)[protocol::AXES]) {
  if (memcmp(newest.position, position, sizeof newest.position) == 0) return;
  ++newest.serial;
  memcpy(newest.position, position, sizeof newest.position);
  newest.seal();
  newest_slot = (newest_slot + 1) % kPlaceRecords;
  place_job.begin(&eeprom.places[newest_slot], &newest);
}

void step() {
  if (!eeprom_is_ready()) return;
  if (fault_job.step() || place_job.step()) return;
  configuration_job.step();
}

}  // namespace store
}  // namespace plugpilot
