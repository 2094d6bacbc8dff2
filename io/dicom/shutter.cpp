#include "io/dicom/shutter.h"

namespace volumen::dicom {
namespace {

constexpr std::uint32_t frameShutter = 0x00189472;
constexpr std::size_t mostCorners = 4096;

Result<ShutterShape> rectangle(const DataSet& data, DataSet::Scope scope) {
  const auto left = data.number(0x00181602, scope), right = data.number(0x00181604, scope);
  const auto top = data.number(0x00181606, scope), bottom = data.number(0x00181608, scope);
  if (!left || !right || !top || !bottom) return Error{"an edge of its rectangle is missing"};
  ShutterShape shape;
  shape.from = {*left, *top};
  shape.to = {*right, *bottom};
  return shape;
}

Result<ShutterShape> circle(const DataSet& data, DataSet::Scope scope) {
  const auto centre = data.numbers(0x00181610, scope);
  const auto radius = data.number(0x00181612, scope);
  if (!centre || centre->size() != 2 || !radius || !(*radius > 0))
    return Error{"the centre or radius of its circle is missing"};
  ShutterShape shape;
  shape.kind = ShutterShape::Kind::circle;
  shape.centre = {(*centre)[1], (*centre)[0]};
  shape.radius = *radius;
  return shape;
}

Result<ShutterShape> polygon(const DataSet& data, DataSet::Scope scope) {
  const auto numbers = data.numbers(0x00181620, scope);
  if (!numbers || numbers->size() < 6 || numbers->size() % 2 == 1)
    return Error{"the corners of its polygon are missing or incomplete"};
  if (numbers->size() > 2 * mostCorners) return Error{"its polygon has more than 4096 corners"};
  ShutterShape shape;
  shape.kind = ShutterShape::Kind::polygon;
  for (std::size_t n = 0; n < numbers->size(); n += 2)
    shape.corners.emplace_back((*numbers)[n + 1], (*numbers)[n]);
  return shape;
}

}  // namespace

Shutter readShutter(const DataSet& data, const FrameScopes& at, std::vector<std::string>& warnings) {
  const DataSet::Scope ofFrame = at.of(frameShutter);
  const DataSet::Scope scope = data.has(0x00181600, ofFrame) ? ofFrame : data.root();
  Shutter shutter;
  shutter.grey = float(data.word(0x00181622, scope).value_or(0) / 65535.0);
  for (const std::string& name : data.values(0x00181600, scope)) {
    Result<ShutterShape> shape = name == "RECTANGULAR" ? rectangle(data, scope)
                                 : name == "CIRCULAR"  ? circle(data, scope)
                                 : name == "POLYGONAL" ? polygon(data, scope)
                                                       : Error{"its shape is " + toUtf8(name, {})};
    if (shape)
      shutter.shapes.push_back(std::move(*shape));
    else
      warnings.push_back("A shutter is left out: " + shape.message() + ".");
  }
  return shutter;
}

}  // namespace volumen::dicom
