#include "io/deidentify/safe_private.h"

#include <string_view>

namespace volumen {

namespace {

struct SafePrivate {
  std::uint16_t group;
  std::string_view creator;
  std::uint8_t element;
};

constexpr SafePrivate safe[] = {
    {0x7053, "Philips PET Private Group", 0x00},  // SUV factor
    {0x7053, "Philips PET Private Group", 0x09},  // activity concentration factor
    {0x00e1, "ELSCINT1", 0x21},                   // dose-length product
    {0x01e1, "ELSCINT1", 0x50},                   // acquisition duration
    {0x01e1, "ELSCINT1", 0x26},                   // phantom type
    {0x01f1, "ELSCINT1", 0x01},                   // acquisition type
    {0x01f1, "ELSCINT1", 0x07},                   // table velocity
    {0x01f1, "ELSCINT1", 0x26},                   // pitch
    {0x01f1, "ELSCINT1", 0x27},                   // rotation time
    {0x0019, "GEMS_ACQU_01", 0x23},               // table speed
    {0x0019, "GEMS_ACQU_01", 0x24},               // mid scan time
    {0x0019, "GEMS_ACQU_01", 0x27},               // rotation speed
    {0x0019, "GEMS_ACQU_01", 0x9e},               // pulse sequence
    {0x0025, "GEMS_SERS_01", 0x07},               // images in series
    {0x0043, "GEMS_PARM_01", 0x27},               // scan pitch ratio
    {0x0043, "GEMS_PARM_01", 0x39},               // b value
    {0x0043, "GEMS_PARM_01", 0x6f},               // scanner table entry
    {0x0045, "GEMS_HELIOS_01", 0x01},             // number of macro rows
    {0x0045, "GEMS_HELIOS_01", 0x02},             // width of macro rows
    {0x0019, "SIEMENS MR HEADER", 0x0c},          // b value
    {0x0019, "SIEMENS MR HEADER", 0x0d},          // diffusion directionality
    {0x0019, "SIEMENS MR HEADER", 0x0e},          // diffusion gradient direction
    {0x0019, "SIEMENS MR HEADER", 0x27},          // b matrix
    {0x2001, "Philips Imaging DD 001", 0x03},     // b value
    {0x2001, "Philips Imaging DD 001", 0x04},     // diffusion direction
    {0x2005, "Philips MR Imaging DD 001", 0x0d},  // scale intercept
    {0x2005, "Philips MR Imaging DD 001", 0x0e},  // scale slope
};

}  // namespace

std::set<std::uint32_t> safePrivateElements(const dicom::DataSet& data, dicom::DataSet::Scope scope) {
  std::set<std::uint32_t> kept, tags;
  for (const SafePrivate& one : safe) {
    const std::uint32_t tag = data.privateTag(one.group, one.creator, one.element, scope);
    if (tag == 0 || !data.find(tag, scope)) continue;
    tags.insert({tag, (tag & 0xffff0000) | (tag >> 8 & 0xff)});
  }
  for (std::uint32_t n = scope.begin; n < scope.end; n = data.element(n).end)
    if (tags.contains(data.element(n).tag)) kept.insert(n);
  return kept;
}

}  // namespace volumen
