#include "viewer/scene/modes.h"
#include "viewer/scene/number_text.h"
#include "viewer/scene/scene_json.h"

namespace volumen {

namespace {

// Scene files are read and edited by people, so the layout is fixed: one line per point, light or plane, in
// the order of picture.md 8.

template <class... Parts>
std::string join(const Parts&... parts) {
  std::string all;
  ((all += parts), ...);
  return all;
}

std::string text(const char* word) { return join("\"", word, "\""); }
std::string text(bool value) { return value ? "true" : "false"; }
std::string text(double value) { return numberText(value); }
std::string text(float value) { return numberText(value); }
std::string text(int value) { return std::to_string(value); }
std::string text(const glm::dvec3& v) { return join("[", text(v.x), ", ", text(v.y), ", ", text(v.z), "]"); }
std::string text(const Window& w);
std::string text(const Camera& c);
std::string text(const CurvePoint& p);
std::string text(const GradientOpacityPoint& p);
std::string text(const Light& l);
std::string text(const ClipPlane& p);

template <class T>
std::string text(const std::optional<T>& value) {
  return value ? text(*value) : "null";
}

template <class T>
std::string text(const std::vector<T>& items, const char* indent) {
  std::string all;
  for (const T& item : items) all += join(all.empty() ? "\n" : ",\n", indent, "  ", text(item));
  return items.empty() ? "[]" : join("[", all, "\n", indent, "]");
}

std::string text(Mode mode) { return text(modeName(mode)); }

std::string text(const Window& w) {
  return join("{\"centre\": ", text(w.centre), ", \"width\": ", text(w.width), "}");
}

std::string text(const CurvePoint& p) {
  return join("{\"value\": ", text(p.value), ", \"colour\": ", text(p.colour),  //
              ", \"opacity\": ", text(p.opacity), "}");
}

std::string text(const GradientOpacityPoint& p) {
  return join("{\"gradient\": ", text(p.gradient), ", \"factor\": ", text(p.factor), "}");
}

std::string text(const TransferFunction& t) {
  return join("{\n    \"unitDistance\": ", text(t.unitDistance),  //
              ",\n    \"points\": ", text(t.points, "    "),      //
              ",\n    \"gradientOpacity\": ", text(t.gradientOpacity, "    "), "\n  }");
}

std::string text(const Shading& s) {
  return join("{\"lit\": ", text(s.lit), ", \"sides\": ", text(s.sides),  //
              ", \"localViewer\": ", text(s.localViewer), ", \"gradientFloor\": ", text(s.gradientFloor),
              ",\n              \"ambient\": ", text(s.ambient), ", \"diffuse\": ", text(s.diffuse),
              ", \"specular\": ", text(s.specular), ", \"shininess\": ", text(s.shininess), "}");
}

std::string text(const Light& l) {
  return join("{\"direction\": ", text(l.direction),  //
              ", \"space\": ", text(l.space == Space::camera ? "camera" : "patient"),
              ", \"colour\": ", text(l.colour), ", \"intensity\": ", text(l.intensity),  //
              ", \"on\": ", text(l.on), "}");
}

std::string text(const Camera& c) {
  return join("{\"target\": ", text(c.target), ", \"direction\": ", text(c.direction),  //
              ", \"up\": ", text(c.up), ",\n             \"projection\": ",
              text(c.projection == Projection::parallel ? "parallel" : "perspective"),
              ", \"height\": ", text(c.height), ", \"fov\": ", text(c.fov),  //
              ", \"distance\": ", text(c.distance), "}");
}

std::string text(const ClipPlane& p) {
  return join("{\"normal\": ", text(p.normal), ", \"offset\": ", text(p.offset), "}");
}

std::string text(const Clip& c) {
  std::string box;
  for (int a = 0; a < 3; ++a) box += join(a ? ", [" : "[", text(c.boxLow[a]), ", ", text(c.boxHigh[a]), "]");
  return join("{\"box\": [", box, "],\n           \"planes\": ", text(c.planes, "           "), "}");
}

std::string text(const Background& b) { return b.transparent ? text("transparent") : text(b.colour); }

}  // namespace

std::string sceneToJson(const Scene& scene) {
  return join("{\n  \"volumenScene\": 1,\n  \"mode\": ", text(scene.mode),  //
              ",\n  \"window\": ", text(scene.window),                      //
              ",\n  \"transferFunction\": ", text(scene.transferFunction),  //
              ",\n  \"shading\": ", text(scene.shading),                    //
              ",\n  \"lights\": ", text(scene.lights, "  "),                //
              ",\n  \"camera\": ", text(scene.camera),                      //
              ",\n  \"clip\": ", text(scene.clip),                          //
              ",\n  \"background\": ", text(scene.background), "\n}\n");
}

}  // namespace volumen
