#include "ui/panels/effects_panel.h"

#include <QScrollBar>
#include <utility>

#include "viewer/render/effect_costs.h"

namespace volumen {

namespace {

QString escaped(const std::string& text) { return QString::fromStdString(text).toHtmlEscaped(); }

// Prevents a line break between number and unit.
QString bracketed(const std::string& cost) {
  return QStringLiteral(" <b>(%1)</b>")
      .arg(escaped(cost).replace(QLatin1Char(' '), QStringLiteral("&nbsp;")));
}

QString stageText(double ms) { return QString::number(ms, 'f', ms < 10 ? 1 : 0); }

}  // namespace

EffectsPanel::EffectsPanel(QWidget* parent) : QTextBrowser(parent) {
  setAccessibleName(tr("Effects: which are on, and why"));
  setFrameShape(QFrame::NoFrame);
  viewport()->setAutoFillBackground(false);
  document()->setDocumentMargin(8);
}

void EffectsPanel::showPlan(const Plan& plan, const RenderStats& stats) {
  QStringList times{tr("%1 ms").arg(stageText(stats.totalMs)),
                    tr("resampling %1 ms").arg(stageText(stats.resampleMs)),
                    tr("shading %1 ms").arg(stageText(stats.shadeMs))};
  if (plan.segments) times << tr("segments %1 ms").arg(stageText(stats.surfacesMs));
  if (stats.gradientsMs >= 1) times << tr("gradients %1 ms (once)").arg(stageText(stats.gradientsMs));
  times << (stats.threads == 1 ? tr("1 thread") : tr("%1 threads").arg(stats.threads));
  QString html = QStringLiteral("<p>%1</p><table cellspacing='0' cellpadding='2'>")
                     .arg(times.join(QStringLiteral(", ")));
  const EffectCosts costs = effectCosts(plan, stats);
  for (std::size_t n = 0; n < costs.size(); ++n) {
    const Effect& effect = plan.effects[n];
    const QString name = escaped(effect.name);
    html +=
        QStringLiteral("<tr><td><b>%1</b>&nbsp;</td><td>%2: %3%4</td></tr>")
            .arg(effect.on ? tr("on") : tr("off"), effect.on ? QStringLiteral("<b>%1</b>").arg(name) : name,
                 escaped(effect.reason), effect.on && costs[n] ? bracketed(costText(*costs[n])) : QString());
  }
  plan_ = html + QStringLiteral("</table>");
  showAll();
}

void EffectsPanel::showNotDrawn(const QString& text) {
  QString html;
  for (const QString& line : text.split(QLatin1Char('\n'), Qt::SkipEmptyParts))
    html += QStringLiteral("<p>%1</p>").arg(line.toHtmlEscaped());
  if (html == std::exchange(notDrawn_, html)) return;
  showAll();
}

void EffectsPanel::showAll() {
  const int scrolled = verticalScrollBar()->value();
  setHtml(notDrawn_ + plan_);
  verticalScrollBar()->setValue(scrolled);
}

}  // namespace volumen
