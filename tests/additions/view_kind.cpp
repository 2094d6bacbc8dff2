// An addition: a kind of view with its own family that shows the name of the series.
#include <QPainter>

#include "results/text/text.h"
#include "ui/views/view.h"
#include "ui/views/view_makers.h"

namespace volumen {

namespace {

class FactsView : public View {
 public:
  using View::View;

 protected:
  void seriesExchanged(bool) override { update(); }
  void workspaceChanged(const Workspace&) override { update(); }
  QString textAt(QPointF) const override { return name(); }
  void paintShown(QPainter& painter) const override { painter.drawText(rect(), Qt::AlignCenter, name()); }

 private:
  QString name() const { return series() ? seriesText(series()->series) : QString(); }
};

}  // namespace

View* makeFactsView(const ViewParts& parts, ViewId id, QWidget* parent) {
  auto* view = new FactsView(parts.session, id, parent);
  view->setObjectName(QStringLiteral("factsView%1").arg(id));
  return view;
}

}  // namespace volumen
