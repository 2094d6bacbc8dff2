#include <QPainter>
#include <QPainterPath>
#include <glm/geometric.hpp>
#include <utility>

#include "ui/tools/tool.h"
#include "ui/workspace/camera_moves.h"

namespace volumen {

namespace {

constexpr double leastStep = 2;  // logical pixels between two points of an outline
constexpr std::size_t fewestPoints = 3;

QPainterPath pathOf(const std::vector<glm::dvec2>& outline) {
  QPainterPath path({outline.front().x, outline.front().y});
  for (const glm::dvec2 p : outline) path.lineTo(p.x, p.y);
  path.closeSubpath();
  path.setFillRule(Qt::WindingFill);
  return path;
}

// Cuts away the inside of the outline; with Ctrl the outside.
class ScissorsDrag : public SceneDrag {
 public:
  ScissorsDrag(const ScenePress& press, std::function<void(const Lasso&)> done)
      : press_(press), done_(std::move(done)), outline_{{press.at.x(), press.at.y()}} {}

  void moveTo(QPointF to, Qt::KeyboardModifiers keys) override {
    const glm::dvec2 p(to.x(), to.y());
    cutsInside_ = !(keys & Qt::ControlModifier);
    if (glm::distance(p, outline_.back()) >= leastStep) outline_.push_back(p);
  }

  bool release(QPointF p, Qt::KeyboardModifiers keys) override {
    moveTo(p, keys);
    if (outline_.size() < fewestPoints) return true;
    Lasso lasso = lassoOf(press_.camera(), press_.size, outline_);
    lasso.inside = cutsInside_;
    done_(lasso);
    return true;
  }

  bool drawsOver() const override { return true; }

  // The part to be cut away is shaded.
  void paint(QPainter& painter, QSizeF size) const override {
    const QPainterPath drawn = pathOf(outline_);
    QPainterPath all;
    all.addRect({QPointF(), size});
    painter.setRenderHint(QPainter::Antialiasing);
    painter.fillPath(cutsInside_ ? drawn : all.subtracted(drawn), QColor(255, 80, 70, 60));
    for (const auto& [colour, width] :
         {std::pair(QColor(Qt::black), 3.0), std::pair(QColor(0xff, 0x8a, 0x80), 1.4)})
      painter.strokePath(drawn, QPen(colour, width));
    painter.setRenderHint(QPainter::Antialiasing, false);
  }

 private:
  const ScenePress press_;
  const std::function<void(const Lasso&)> done_;
  std::vector<glm::dvec2> outline_;  // logical pixels
  bool cutsInside_ = true;
};

}  // namespace

std::unique_ptr<SceneDrag> drawLasso(const ScenePress& press, std::function<void(const Lasso& lasso)> done) {
  return std::make_unique<ScissorsDrag>(press, std::move(done));
}

std::unique_ptr<SceneDrag> beginScissors(const ScenePress& press) { return drawLasso(press, press.cut); }

}  // namespace volumen
