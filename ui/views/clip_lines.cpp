#include "ui/views/clip_lines.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "ui/workspace/clip_box.h"

namespace volumen {

namespace {

constexpr double clipReach = 4;  // logical pixels from the press

// Returns the scene of the 3D view in focus, or null if it shows another series.
const Scene* sceneOf(const SlicePress& press) {
  const Workspace& workspace = press.session.workspace();
  const ViewState& view = workspace.view(sceneViewOf(workspace));
  const auto look = view.scenes.find(view.series);
  return view.series == keyOf(press.series->series) && look != view.scenes.end() ? &look->second.scene
                                                                                 : nullptr;
}

double distanceFrom(const QLineF& line, QPointF p) {
  const QPointF along = line.p2() - line.p1();
  const double square = QPointF::dotProduct(along, along);
  const double t =
      square > 0 ? std::clamp(QPointF::dotProduct(p - line.p1(), along) / square, 0.0, 1.0) : 0.0;
  return QLineF(p, line.pointAt(t)).length();
}

const ClipLine* clipLineAt(const std::vector<ClipLine>& lines, QPointF p) {
  const auto nearest =
      std::ranges::min_element(lines, {}, [&](const ClipLine& l) { return distanceFrom(l.line, p); });
  return nearest != lines.end() && distanceFrom(nearest->line, p) <= clipReach ? &*nearest : nullptr;
}

// Moves a face of the clip box with its edge.
class ClipDrag : public Drag {
 public:
  ClipDrag(const SlicePress& press, const ClipLine& line)
      : press_(press), line_(line), atPress_(sceneOf(press)->clip) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    const int axis = line_.axis;
    const double before = (line_.high ? atPress_.boxHigh : atPress_.boxLow)[axis];
    const double way = fractionAt(p) - fractionAt(press_.at);
    const QString what = QCoreApplication::translate("volumen", "Clip");
    press_.session.edit(
        what,
        [&](Scene& scene) {
          scene.clip = atPress_;
          moveClipFace(scene.clip, axis, line_.high, before + way);
        },
        what);
  }

 private:
  double fractionAt(QPointF p) const {
    const VoxelGeometry& geometry = press_.series->volume->geometry();
    return (geometry.voxelFromPatient(press_.patientAt(p))[line_.axis] + 0.5) / geometry.size[line_.axis];
  }

  const SlicePress press_;
  const ClipLine line_;
  const Clip atPress_;
};

}  // namespace

std::vector<ClipLine> clipLines(const SlicePress& press, bool whole) {
  std::vector<ClipLine> lines;
  const Scene* scene = press.frame ? nullptr : sceneOf(press);
  const Clip none;
  if (!scene || (!whole && scene->clip.boxLow == none.boxLow && scene->clip.boxHigh == none.boxHigh))
    return lines;
  for (const ClipEdge& edge : clipEdges(scene->clip, press.series->volume->geometry(), press.plane))
    lines.push_back({edge.axis, edge.high, QLineF(press.pixelAt(edge.from), press.pixelAt(edge.to))});
  return lines;
}

void paintClipLines(QPainter& painter, const std::vector<ClipLine>& lines) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  for (const auto& [colour, width] :
       {std::pair(QColor(0, 0, 0, 120), 2.5), {QColor(0x6c, 0xd4, 0xff), 1.0}}) {
    painter.setPen(QPen(colour, width));
    for (const ClipLine& line : lines) painter.drawLine(line.line);
  }
  painter.restore();
}

bool isOnClip(const SlicePress& press, bool whole) {
  return clipLineAt(clipLines(press, whole), press.at) != nullptr;
}

std::unique_ptr<Drag> beginOnClip(const SlicePress& press, bool whole) {
  const std::vector<ClipLine> lines = clipLines(press, whole);
  const ClipLine* line = clipLineAt(lines, press.at);
  return line ? std::make_unique<ClipDrag>(press, *line) : nullptr;
}

}  // namespace volumen
