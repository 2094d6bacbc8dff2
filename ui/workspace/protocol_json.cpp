#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "ui/workspace/hanging_protocol.h"
#include "viewer/scene/json_fields.h"
#include "viewer/scene/number_text.h"

namespace volumen {

namespace {

using ProtocolJson = nlohmann::ordered_json;

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

// ProtocolWriter and ProtocolReader have the same functions, so that one list of fields both writes and reads
// a struct. Default values are not written.
class ProtocolWriter {
 public:
  template <class T>
  void plain(const char* name, T& value, const T& usual) {
    if (value != usual) json[name] = value;
  }
  void number(const char* name, double& value, double usual, double, double) { plain(name, value, usual); }
  void count(const char* name, int& value, int usual, int, int) { plain(name, value, usual); }
  template <class T>
  void word(const char* name, T& value, const T& usual, const Words<T>& words) {
    for (const auto& [text, meaning] : words)
      if (meaning == value && value != usual) json[name] = text;
  }
  template <class T>
  void optional(const char* name, std::optional<T>& value, const Words<T>& words) {
    for (const auto& [text, meaning] : words)
      if (value == meaning) json[name] = text;
  }
  void optional(const char* name, std::optional<bool>& value) {
    if (value) json[name] = *value;
  }
  template <class T>
  void object(const char* name, T& value) {
    if (ProtocolJson part = objectOf(value); !part.empty()) json[name] = std::move(part);
  }
  template <class T>
  void object(const char* name, std::optional<T>& value) {
    if (value) json[name] = objectOf(*value);
  }
  template <class T>
  void list(const char* name, std::vector<T>& items) {
    json[name] = ProtocolJson::array();
    for (T& item : items) json[name].push_back(objectOf(item));
  }
  void layout(const char* name, Layout& value) {
    json[name] = std::to_string(value.rows) + "x" + std::to_string(value.columns);
  }
  void require(const char*, bool, const char*) {}

  ProtocolJson json = ProtocolJson::object();

 private:
  template <class T>
  static ProtocolJson objectOf(T& value) {
    ProtocolWriter writer;
    protocolFields(writer, value);
    return writer.json;
  }
};

class ProtocolReader {
 public:
  explicit ProtocolReader(JsonFields& json) : json_(json) {}

  template <class T>
  void plain(const char* name, T& value, const T&) {
    json_.read(name, value);
  }
  void number(const char* name, double& value, double, double low, double high) {
    json_.read(name, value);
    check(name, value, low, high);
  }
  void count(const char* name, int& value, int, int low, int high) {
    json_.read(name, value);
    check(name, value, low, high);
  }
  template <class T>
  void word(const char* name, T& value, const T&, const Words<T>& words) {
    json_.read(name, value, words);
  }
  template <class T>
  void optional(const char* name, std::optional<T>& value, const Words<T>& words) {
    if (!json_.raw(name)) return;
    T read = words.front().second;
    json_.read(name, read, words);
    value = read;
  }
  void optional(const char* name, std::optional<bool>& value) {
    if (!json_.raw(name)) return;
    bool read = false;
    json_.read(name, read);
    value = read;
  }
  template <class T>
  void object(const char* name, T& value) {
    if (auto part = json_.object(name)) read(*part, value);
  }
  template <class T>
  void object(const char* name, std::optional<T>& value) {
    auto part = json_.object(name);
    if (!part) return;
    T item;
    read(*part, item);
    value = item;
  }
  template <class T>
  void list(const char* name, std::vector<T>& items) {
    json_.readList(name, items, [](JsonFields part) {
      T item;
      read(part, item);
      return item;
    });
  }
  void layout(const char* name, Layout& value) {
    std::string text = "1x2";
    json_.read(name, text);
    for (int rows = 1; rows <= Layout::mostRows; ++rows)
      for (int columns = 1; columns <= Layout::mostColumns; ++columns)
        if (text == std::to_string(rows) + "x" + std::to_string(columns))
          return void(value = {Layout::Kind::grid, rows, columns});
    json_.refuse(json_.pathOf(name),
                 "must be rows and columns, \"1x1\" to \"4x5\", not " + JsonFields::quoted(text));
  }
  void require(const char* name, bool kept, const char* sentence) {
    if (!kept) json_.refuse(json_.pathOf(name), sentence);
  }

 private:
  template <class T>
  static void read(JsonFields& part, T& value) {
    ProtocolReader reader(part);
    protocolFields(reader, value);
    part.refuseOthers();
  }
  void check(const char* name, double value, double low, double high) {
    if (!(value >= low && value <= high))
      json_.refuse(json_.pathOf(name), "must be in " + numberText(low) + " .. " + numberText(high) +
                                           ", not " + numberText(value));
  }

  JsonFields& json_;
};

template <class Fields>
void protocolFields(Fields& f, SeriesRule& rule) {
  const SeriesRule any;
  f.plain("modality", rule.modality, any.modality);
  f.plain("bodyPart", rule.bodyPart, any.bodyPart);
  f.plain("laterality", rule.laterality, any.laterality);
  f.plain("viewPosition", rule.viewPosition, any.viewPosition);
  f.plain("description", rule.description, any.description);
  f.plain("notDescription", rule.notDescription, any.notDescription);
  f.optional("plane", rule.plane, planeWords);
  f.optional("weighting", rule.weighting, weightingWords);
  f.optional("kernel", rule.kernel, kernelWords);
  f.optional("contrast", rule.contrast);
}

template <class Fields>
void protocolFields(Fields& f, ProtocolCondition& when) {
  protocolFields(f, when.rule);
  const ProtocolCondition any;
  f.count("least", when.least, any.least, 0, 10000);
  f.count("most", when.most, any.most, 1, 10000);
  f.plain("prior", when.prior, false);
}

template <class Fields>
void protocolFields(Fields& f, ProtocolSeries& series) {
  f.plain("name", series.name, std::string());
  f.require("name", !series.name.empty() && series.name.find('|') == std::string::npos,
            "must be a name without \"|\"");
  protocolFields(f, series.rule);
  f.word("order", series.order, SeriesOrder::number, orderWords);
  f.count("prior", series.prior, 0, 0, 100);
  f.plain("like", series.like, std::string());
}

template <class Fields>
void protocolFields(Fields& f, Window& window) {
  constexpr double never = -1e300;  // no default: both are always written
  f.number("centre", window.centre, never, -mostOfWindow, mostOfWindow);
  f.number("width", window.width, never, -mostOfWindow, mostOfWindow);
  f.require("width", std::abs(window.width) >= leastWidthOfWindow,
            "must be at least 1e-9 wide, inverted or not");
}

template <class Fields>
void protocolFields(Fields& f, ProtocolCell& cell) {
  f.plain("series", cell.series, std::string());
  f.count("which", cell.which, 1, 1, 10000);
  f.word("picture", cell.picture, CellPicture::asAcquired, pictureWords);
  f.object("window", cell.window);
  f.plain("over", cell.over, std::string());
  f.number("slabMm", cell.slabMm, 0, 0, 1000);
  f.word("slabMode", cell.slabMode, SlabMode::max, slabModeWords);
  f.plain("inverted", cell.inverted, false);
  f.word("chestWall", cell.chestWall, ChestWall::anywhere, wallWords);
}

template <class Fields>
void protocolFields(Fields& f, Links& links) {
  const Links usual;
  f.plain("scroll", links.scroll, usual.scroll);
  f.plain("zoom", links.zoom, usual.zoom);
  f.plain("pan", links.pan, usual.pan);
  f.plain("window", links.window, usual.window);
}

template <class Fields>
void protocolFields(Fields& f, HangingProtocol& protocol) {
  f.plain("name", protocol.name, std::string());
  f.require("name", !protocol.name.empty(), "must not be empty");
  f.object("when", protocol.when);
  f.list("series", protocol.series);
  f.layout("layout", protocol.layout);
  f.list("cells", protocol.cells);
  f.count("leastFilled", protocol.leastFilled, 1, 0, 20);
  f.object("links", protocol.links);
  f.plain("sameScale", protocol.sameScale, false);
  f.plain("automatic", protocol.automatic, false);
}

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
  JsonFields json(*parsed, "", problem);
  HangingProtocol protocol;
  ProtocolReader reader(json);
  protocolFields(reader, protocol);
  json.refuseOthers();
  if (problem.empty()) checkProtocol(json, protocol);
  if (!problem.empty()) return Error{problem};
  return protocol;
}

std::string protocolToJson(const HangingProtocol& protocol) {
  HangingProtocol copy = protocol;
  ProtocolWriter writer;
  protocolFields(writer, copy);
  return writer.json.dump(1, ' ', false, ProtocolJson::error_handler_t::replace) + "\n";
}

}  // namespace volumen
