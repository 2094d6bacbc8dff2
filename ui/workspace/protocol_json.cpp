#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/workspace/hanging_protocol.h"
#include "viewer/scene/fields.h"

namespace volumen {

namespace {

const Words<SeriesOrder> orderWords{{"number", SeriesOrder::number},
                                    {"time", SeriesOrder::time},
                                    {"description", SeriesOrder::description},
                                    {"slices", SeriesOrder::slices}};
const Words<ViewKind> planeWords{
    {"axial", ViewKind::axial}, {"coronal", ViewKind::coronal}, {"sagittal", ViewKind::sagittal}};
const Words<Weighting> weightingWords{{"T1", Weighting::t1},
                                      {"T2", Weighting::t2},
                                      {"T2*", Weighting::t2Star},
                                      {"FLAIR", Weighting::flair},
                                      {"diffusion", Weighting::diffusion},
                                      {"ADC", Weighting::adc},
                                      {"PD", Weighting::protonDensity},
                                      {"angiography", Weighting::angiography}};
const Words<Kernel> kernelWords{{"soft", Kernel::soft}, {"lung", Kernel::lung}, {"bone", Kernel::bone}};
const Words<CellPicture> pictureWords{
    {"acquired", CellPicture::asAcquired}, {"axial", CellPicture::axial}, {"coronal", CellPicture::coronal},
    {"sagittal", CellPicture::sagittal},   {"3D", CellPicture::scene},    {"frames", CellPicture::frames}};
const Words<SlabMode> slabModeWords{{"max", SlabMode::max}, {"min", SlabMode::min}, {"mean", SlabMode::mean}};
const Words<ChestWall> wallWords{
    {"anywhere", ChestWall::anywhere}, {"left", ChestWall::left}, {"right", ChestWall::right}};

}  // namespace

// Windows and links of protocols, which have other fields and limits than those of sessions.
struct ProtocolWindow : Window {};
struct ProtocolLinks : Links {
  bool operator==(const ProtocolLinks&) const = default;
};

static void fields(Fields& f, SeriesRule& rule) {
  for (const auto& [name, words] : {std::pair("modality", &SeriesRule::modality),
                                    {"bodyPart", &SeriesRule::bodyPart},
                                    {"laterality", &SeriesRule::laterality},
                                    {"viewPosition", &SeriesRule::viewPosition},
                                    {"description", &SeriesRule::description},
                                    {"notDescription", &SeriesRule::notDescription}})
    f.unless({}, name, rule.*words);
  f.unlessNone("plane", rule.plane, planeWords);
  f.unlessNone("weighting", rule.weighting, weightingWords);
  f.unlessNone("kernel", rule.kernel, kernelWords);
  f.unlessNone("contrast", rule.contrast);
}

static void fields(Fields& f, ProtocolCondition& when) {
  fields(f, when.rule);
  const ProtocolCondition any;
  f.unless(any.least, "least", when.least, Limits{0, 10000});
  f.unless(any.most, "most", when.most, Limits{1, 10000});
  f.unless(false, "prior", when.prior);
}

static void fields(Fields& f, ProtocolSeries& series) {
  f.unless({}, "name", series.name);
  f.require("name", !series.name.empty() && series.name.find('|') == std::string::npos,
            "must be a name without \"|\"");
  fields(f, series.rule);
  f.unless(SeriesOrder::number, "order", series.order, orderWords);
  f.unless(0, "prior", series.prior, Limits{0, 100});
  f.unless({}, "like", series.like);
}

static void fields(Fields& f, ProtocolWindow& window) {
  f("centre", window.centre, {-mostOfWindow, mostOfWindow});
  f("width", window.width, {-mostOfWindow, mostOfWindow});
  f.require("width", std::abs(window.width) >= leastWidthOfWindow,
            "must be at least 1e-9 wide, inverted or not");
}

static void fields(Fields& f, ProtocolCell& cell) {
  std::optional<ProtocolWindow> window;
  if (cell.window) window = {*cell.window};
  f.unless({}, "series", cell.series);
  f.unless(1, "which", cell.which, Limits{1, 10000});
  f.unless(CellPicture::asAcquired, "picture", cell.picture, pictureWords);
  f.unlessNone("window", window);
  f.unless({}, "over", cell.over);
  f.unless(0.0, "slabMm", cell.slabMm, Limits{0, 1000});
  f.unless(SlabMode::max, "slabMode", cell.slabMode, slabModeWords);
  f.unless(false, "inverted", cell.inverted);
  f.unless(ChestWall::anywhere, "chestWall", cell.chestWall, wallWords);
  if (window) cell.window = *window;
}

static void fields(Fields& f, ProtocolLinks& links) {
  const Links usual;
  f.unless(usual.scroll, "scroll", links.scroll);
  f.unless(usual.zoom, "zoom", links.zoom);
  f.unless(usual.pan, "pan", links.pan);
  f.unless(usual.window, "window", links.window);
}

static void layoutField(Fields& f, Layout& layout) {
  const auto textOf = [](int rows, int columns) {
    return std::to_string(rows) + "x" + std::to_string(columns);
  };
  std::string text = textOf(layout.rows, layout.columns);
  f("layout", text);
  layout = {};
  for (int rows = 1; rows <= Layout::mostRows; ++rows)
    for (int columns = 1; columns <= Layout::mostColumns; ++columns)
      if (text == textOf(rows, columns)) layout = {Layout::Kind::grid, rows, columns};
  f.require("layout", layout != Layout(),
            "must be rows and columns, \"1x1\" to \"4x5\", not " + JsonFields::quoted(text));
}

static void fields(Fields& f, HangingProtocol& protocol) {
  ProtocolLinks links{protocol.links};
  f.unless({}, "name", protocol.name);
  f.require("name", !protocol.name.empty(), "must not be empty");
  f.unless({}, "when", protocol.when);
  f("series", protocol.series);
  layoutField(f, protocol.layout);
  f("cells", protocol.cells);
  f.unless(1, "leastFilled", protocol.leastFilled, Limits{0, 20});
  f.unless({}, "links", links);
  protocol.links = links;
  f.unless(false, "sameScale", protocol.sameScale);
  f.unless(false, "automatic", protocol.automatic);
}

namespace {

// Checks that the fields agree with each other.
void checkProtocol(JsonFields& json, const HangingProtocol& protocol) {
  const auto isName = [&](const std::string& name) {
    return std::ranges::find(protocol.series, name, &ProtocolSeries::name) != protocol.series.end();
  };
  const auto refuse = [&](const std::string& path, const std::string& name) {
    json.refuse(path, "must be the name of one of the series, not " + JsonFields::quoted(name));
  };
  constexpr std::size_t mostSeries = 100;
  if (protocol.series.size() > mostSeries) return json.refuse("series", "must be at most 100");
  for (std::size_t n = 0; n < protocol.series.size(); ++n) {
    const ProtocolSeries& series = protocol.series[n];
    const std::string path = json.pathOf("series", n);
    if (std::ranges::count(protocol.series, series.name, &ProtocolSeries::name) > 1)
      json.refuse(path + ".name", "is there twice");
    if (!series.like.empty() && !isName(series.like)) refuse(path + ".like", series.like);
    if (!series.like.empty() && series.prior < 1) json.refuse(path + ".prior", "must be 1 or more");
    if (!series.like.empty() && series.rule != SeriesRule())
      json.refuse(path + ".like", "must stand without a rule");
  }
  const auto most = std::size_t(protocol.layout.rows * protocol.layout.columns);
  if (protocol.cells.size() > most)
    json.refuse("cells", "must be at most " + std::to_string(most) + ", as the layout has");
  for (std::size_t n = 0; n < protocol.cells.size(); ++n) {
    const ProtocolCell& cell = protocol.cells[n];
    std::string name;
    for (const char c : cell.series + '|')
      if (c != '|')
        name += c;
      else if (!name.empty() && !isName(std::exchange(name, {})))
        return refuse(json.pathOf("cells", n) + ".series", cell.series);
    if (!cell.over.empty() && !isName(cell.over)) refuse(json.pathOf("cells", n) + ".over", cell.over);
  }
}

}  // namespace

Result<HangingProtocol> protocolFromJson(const std::string& text) {
  const auto parsed = parseJson(text, 1);
  if (!parsed) return parsed.error();
  std::string problem;
  Fields f(JsonFields(*parsed, "", problem));
  HangingProtocol protocol;
  fields(f, protocol);
  f.refuseOthers();
  if (problem.empty()) checkProtocol(f, protocol);
  if (!problem.empty()) return Error{problem};
  return protocol;
}

std::string protocolToJson(const HangingProtocol& protocol) {
  return jsonOf(protocol).dump(1, ' ', false, JsonFields::Json::error_handler_t::replace) + "\n";
}

}  // namespace volumen
