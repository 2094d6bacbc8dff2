#include "ui/panels/effects_panel.h"

#include <QScrollArea>
#include <QVBoxLayout>

namespace volumen {

namespace {

QString escaped(const std::string& text) { return QString::fromStdString(text).toHtmlEscaped(); }

}  // namespace

EffectsPanel::EffectsPanel(QWidget* parent) : QWidget(parent), lines_(new QLabel), times_(new QLabel) {
  lines_->setObjectName(QStringLiteral("effectLines"));
  lines_->setTextFormat(Qt::RichText);
  for (QLabel* label : {lines_, times_}) {
    label->setWordWrap(true);
    label->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  }
  times_->setObjectName(QStringLiteral("frameTimes"));
  auto* inner = new QWidget;
  auto* lines = new QVBoxLayout(inner);
  lines->setContentsMargins(8, 8, 8, 8);
  lines->addWidget(times_);
  lines->addWidget(lines_, 1);
  auto* scroll = new QScrollArea;
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidget(inner);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(scroll);
}

void EffectsPanel::showPlan(const Plan& plan, const RenderStats& stats) {
  QString html = QStringLiteral("<table cellspacing='0' cellpadding='2'>");
  for (const Effect& effect : plan.effects) {
    const QString name = escaped(effect.name);
    html += QStringLiteral("<tr><td><b>%1</b>&nbsp;</td><td>%2: %3</td></tr>")
                .arg(effect.on ? tr("on") : tr("off"),
                     effect.on ? QStringLiteral("<b>%1</b>").arg(name) : name, escaped(effect.reason));
  }
  lines_->setText(html + QStringLiteral("</table>"));
  const auto ms = [](double value) { return QString::number(value, 'f', value < 10 ? 1 : 0); };
  QStringList parts{tr("%1 ms").arg(ms(stats.totalMs)), tr("resampling %1 ms").arg(ms(stats.resampleMs)),
                    tr("shading %1 ms").arg(ms(stats.shadeMs))};
  if (stats.gradientsMs > 0) parts << tr("gradients %1 ms, once").arg(ms(stats.gradientsMs));
  parts << tr("%n thread(s)", nullptr, stats.threads);
  times_->setText(parts.join(QStringLiteral(", ")));
}

}  // namespace volumen
