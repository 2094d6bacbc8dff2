#include "io/dicom/greys.h"

#include <algorithm>
#include <cmath>

#include "io/dicom/lookup_table.h"
#include "io/dicom/units.h"

namespace volumen::dicom {
namespace {

/// Returns the VOILUTFunction of a scope, or empty, which means LINEAR. Unknown functions are remarked.
std::string readFunction(const DataSet& data, DataSet::Scope scope) {
  constexpr std::size_t mostShown = 64;
  constexpr std::uint32_t voiLutFunction = 0x00281056;
  const auto known = {"LINEAR", "LINEAR_EXACT", "SIGMOID"};
  std::string function = data.term(voiLutFunction, scope, "VOILUTFunction", known);
  if (function.empty() || std::ranges::find(known, function) != known.end()) return function;
  data.remark("its VOILUTFunction \"" + toUtf8(function.substr(0, mostShown), {}) +
              "\" is not known: it was read as LINEAR");
  return {};
}

/// Returns the window function. LINEAR is undefined for widths below 1 and becomes LINEAR_EXACT there.
WindowFunction functionOf(const std::string& name, double width) {
  if (name == "SIGMOID") return WindowFunction::sigmoid;
  const bool exact = name == "LINEAR_EXACT" || width < 1;
  return exact ? WindowFunction::linearExact : WindowFunction::linear;
}

NamedGrey greyOf(const LookupTable& table, const std::string& name) {
  NamedGrey grey{name, {}};
  grey.mapping.table.first = table.first;
  for (const std::uint16_t entry : table.entries)
    grey.mapping.table.grey.push_back(float(std::min(1.0, entry / table.top())));
  grey.mapping.window = {table.first + double(table.entries.size()) / 2, double(table.entries.size())};
  return grey;
}

/// Shows a table by its own range if it uses at least two bits less than it says, as it would be nearly
/// black.
void useOwnRange(LookupTable& table, std::vector<std::string>& warnings) {
  const int used = table.usedBits();
  if (used == 0 || used > table.bits - 2) return;
  warnings.push_back("A VOI LUT says that it has " + std::to_string(table.bits) +
                     " bits, and its values use " + std::to_string(used) + ": it is shown by their range.");
  table.bits = used;
}

/// Returns the window of percentiles 0.1 and 99.9 (picture.md 5) of all values but padding.
Window ownWindow(const Frame& frame) {
  SharedWindow own;
  own.add(frame.values, frame.padding);
  return own.window();
}

}  // namespace

std::vector<NamedGrey> readWindows(const DataSet& data, DataSet::Scope scope) {
  std::vector<NamedGrey> greys;
  const auto centres = data.numbers(0x00281050, scope), widths = data.numbers(0x00281051, scope);
  if (!centres || !widths) return greys;
  const std::string function = readFunction(data, scope);
  std::vector<std::string> names;
  if (data.has(0x00281055, scope)) names = data.values(0x00281055, scope);
  for (std::size_t n = 0; n < std::min(centres->size(), widths->size()); ++n) {
    if (!((*widths)[n] > 0)) continue;
    NamedGrey grey;
    if (n < names.size()) grey.name = toUtf8(names[n], data.text(0x00080005, data.root()));
    grey.mapping.window = {(*centres)[n], (*widths)[n]};
    grey.mapping.function = functionOf(function, (*widths)[n]);
    greys.push_back(grey);
  }
  return greys;
}

std::vector<NamedGrey> readMappings(const DataSet& data, DataSet::Scope scope, bool signedInput,
                                    std::vector<std::string>& warnings) {
  std::vector<NamedGrey> greys = readWindows(data, scope);
  for (const DataSet::Scope item : data.items(0x00283010, scope)) {
    auto table = readLookupTable(data, item, {0x00283002, 0x00283006}, signedInput);
    if (!table) {
      warnings.push_back("A VOI LUT is left out: " + table.message() + ".");
      continue;
    }
    useOwnRange(*table, warnings);
    greys.push_back(greyOf(*table, data.utf8(0x00283003, item)));
  }
  return greys;
}

bool isInverse(const DataSet& data) {
  return data.term(0x20500020, data.root(), "PresentationLUTShape", {"IDENTITY", "INVERSE"}) == "INVERSE";
}

Status readModalityLut(const DataSet& data, bool isSigned, ValueMapping& mapping) {
  const auto items = data.items(0x00283000, data.root());
  if (items.empty()) return {};
  auto table = readLookupTable(data, items[0], {0x00283002, 0x00283006}, isSigned);
  if (!table) return table.error();
  mapping.first = table->first;
  mapping.table = std::move(table->entries);
  mapping.unit = unitOfRescaleType(data.utf8(0x00283004, items[0]));
  return {};
}

const std::string realWorldSentence =
    "values are those of its Real World Value Mapping, not the stored ones; its windows go with them";

NamedGrey greyOfSlice(NamedGrey grey, const Slice& slice) {
  if (!slice.isMapped) return grey;
  GreyMapping& m = grey.mapping;
  m.table.first += slice.intercept;
  // LINEAR counts in steps of 1.
  if (m.function == WindowFunction::linear && slice.slope != 1) {
    constexpr double narrowest = 1e-3;  // width from black to white, in steps
    m.window = {m.window.centre - 0.5, std::max(narrowest, m.window.width - 1)};
    m.function = WindowFunction::linearExact;
  }
  m.window.centre = slice.slope * m.window.centre + slice.intercept;
  m.window.width *= std::abs(slice.slope);
  if (slice.slope < 0) m.inverted = !m.inverted;
  return grey;
}

std::vector<NamedGrey> readGreys(const DataSet& data, const FrameScopes& at, const FileHeader& header,
                                 const Slice& slice, const Frame& frame, std::vector<std::string>& warnings) {
  const bool signedInput = header.format.isSigned || (!slice.isMapped && frame.values.anyNegative());
  std::vector<NamedGrey> greys = readMappings(data, at.of(frameVoiLut), signedInput, warnings);
  const auto isTable = [](const NamedGrey& grey) { return !grey.mapping.table.grey.empty(); };
  if (slice.isMapped && slice.slope != 1 && std::erase_if(greys, isTable) > 0)
    warnings.emplace_back("Its VOI LUTs are left out: they are of stored values, and it has mapped ones.");
  if (greys.empty()) greys.push_back({{}, {ownWindow(frame), WindowFunction::linearExact, {}, false}, true});
  const bool inverted = header.format.photometric == "MONOCHROME1" || isInverse(data);
  const bool floats = header.format.kind != PixelFormat::Kind::integer;
  for (NamedGrey& grey : greys) {
    grey.mapping.inverted = inverted;
    if (!grey.ofValues) grey = greyOfSlice(std::move(grey), slice);
    // LINEAR is for integers (slices.md 3).
    if (floats && grey.mapping.function == WindowFunction::linear)
      grey.mapping.function = WindowFunction::linearExact;
  }
  return greys;
}

}  // namespace volumen::dicom
