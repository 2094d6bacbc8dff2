#include "io/deidentify/safe_private.h"

#include <algorithm>
#include <string_view>

namespace volumen {

namespace {

using dicom::Element;
using dicom::vrOf;

struct SafePrivate {
  std::uint16_t group;
  std::string_view creator;
  std::uint8_t element;
  std::uint16_t vr;
};

constexpr SafePrivate safe[] = {
    {0x7053, "Philips PET Private Group", 0x00, vrOf('D', 'S')},  // SUV factor
    {0x7053, "Philips PET Private Group", 0x09, vrOf('D', 'S')},  // activity concentration factor
    {0x00e1, "ELSCINT1", 0x21, vrOf('D', 'S')},                   // dose-length product
    {0x01e1, "ELSCINT1", 0x50, vrOf('D', 'S')},                   // acquisition duration
    {0x01e1, "ELSCINT1", 0x26, vrOf('C', 'S')},                   // phantom type
    {0x01f1, "ELSCINT1", 0x01, vrOf('C', 'S')},                   // acquisition type
    {0x01f1, "ELSCINT1", 0x07, vrOf('D', 'S')},                   // table velocity
    {0x01f1, "ELSCINT1", 0x26, vrOf('D', 'S')},                   // pitch
    {0x01f1, "ELSCINT1", 0x27, vrOf('D', 'S')},                   // rotation time
    {0x0019, "GEMS_ACQU_01", 0x23, vrOf('D', 'S')},               // table speed
    {0x0019, "GEMS_ACQU_01", 0x24, vrOf('D', 'S')},               // mid scan time
    {0x0019, "GEMS_ACQU_01", 0x27, vrOf('D', 'S')},               // rotation speed
    {0x0019, "GEMS_ACQU_01", 0x9e, vrOf('L', 'O')},               // pulse sequence
    {0x0025, "GEMS_SERS_01", 0x07, vrOf('S', 'L')},               // images in series
    {0x0043, "GEMS_PARM_01", 0x27, vrOf('S', 'H')},               // scan pitch ratio
    {0x0043, "GEMS_PARM_01", 0x39, vrOf('I', 'S')},               // b value
    {0x0043, "GEMS_PARM_01", 0x6f, vrOf('D', 'S')},               // scanner table entry
    {0x0045, "GEMS_HELIOS_01", 0x01, vrOf('S', 'S')},             // number of macro rows
    {0x0045, "GEMS_HELIOS_01", 0x02, vrOf('F', 'L')},             // width of macro rows
    {0x0019, "SIEMENS MR HEADER", 0x0c, vrOf('I', 'S')},          // b value
    {0x0019, "SIEMENS MR HEADER", 0x0d, vrOf('C', 'S')},          // diffusion directionality
    {0x0019, "SIEMENS MR HEADER", 0x0e, vrOf('F', 'D')},          // diffusion gradient direction
    {0x0019, "SIEMENS MR HEADER", 0x27, vrOf('F', 'D')},          // b matrix
    {0x2001, "Philips Imaging DD 001", 0x03, vrOf('F', 'L')},     // b value
    {0x2001, "Philips Imaging DD 001", 0x04, vrOf('C', 'S')},     // diffusion direction
    {0x2005, "Philips MR Imaging DD 001", 0x0d, vrOf('F', 'L')},  // scale intercept
    {0x2005, "Philips MR Imaging DD 001", 0x0e, vrOf('F', 'L')},  // scale slope
};

bool isOneOf(std::uint16_t vr, std::initializer_list<std::uint16_t> all) {
  return std::ranges::find(all, vr) != all.end();
}

// Returns the size of a number of a binary VR in bytes; 0 for other VRs.
std::uint64_t sizeOfNumber(std::uint16_t vr) {
  if (isOneOf(vr, {vrOf('U', 'S'), vrOf('S', 'S')})) return 2;
  if (isOneOf(vr, {vrOf('U', 'L'), vrOf('S', 'L'), vrOf('F', 'L')})) return 4;
  return vr == vrOf('F', 'D') ? 8 : 0;
}

// Returns true if the values can be what the list says: numbers, or short texts.
bool fits(const Element& e, std::uint16_t listed, const dicom::DataSet& data, dicom::DataSet::Scope scope) {
  constexpr std::uint64_t longest = 4096;  // bytes; all values of the list are short
  if (e.length == 0) return true;
  if (e.length > longest) return false;
  const std::uint16_t vr = vrOfPrivate(e, listed);
  const bool isText =
      isOneOf(vr, {vrOf('C', 'S'), vrOf('L', 'O'), vrOf('S', 'H'), vrOf('L', 'T'), vrOf('S', 'T')});
  const bool isDecimal = isOneOf(vr, {vrOf('D', 'S'), vrOf('I', 'S')});
  const std::uint64_t size = sizeOfNumber(vr);
  const bool isListedText = isOneOf(listed, {vrOf('C', 'S'), vrOf('L', 'O'), vrOf('S', 'H')});
  if (size > 0) return !isListedText && e.length % size == 0;
  const std::size_t most = listed == vrOf('L', 'O') ? 64 : 16;
  return (isText || (isDecimal && !isListedText)) &&
         std::ranges::all_of(data.values(e.tag, scope), [&](const std::string& value) {
           return isListedText ? value.size() <= most : value.empty() || dicom::parseNumber(value);
         });
}

}  // namespace

std::uint16_t vrOfPrivate(const Element& e, std::uint16_t listed) {
  return e.vr == 0 || e.vr == vrOf('U', 'N') ? listed : e.vr;
}

std::map<std::uint32_t, std::uint16_t> safePrivateElements(const dicom::DataSet& data,
                                                           dicom::DataSet::Scope scope) {
  std::map<std::uint32_t, std::uint16_t> vrs, kept;
  for (const SafePrivate& one : safe) {
    const std::uint32_t tag = data.privateTag(one.group, one.creator, one.element, scope);
    const Element* const e = tag == 0 ? nullptr : data.find(tag, scope);
    const bool isValue = e && e->length != dicom::undefinedLength && &data.element(e->end - 1) == e;
    if (!isValue || !fits(*e, one.vr, data, scope)) continue;
    vrs.emplace(tag, one.vr);
    vrs.emplace((tag & 0xffff0000) | (tag >> 8 & 0xff), vrOf('L', 'O'));
  }
  // Of elements with one tag, DataSet knows only the first.
  for (std::uint32_t n = scope.begin; n < scope.end; n = data.element(n).end)
    if (const auto found = vrs.extract(data.element(n).tag)) kept.emplace(n, found.mapped());
  return kept;
}

}  // namespace volumen
