#include "results/plots/study_charts.h"

#include <algorithm>
#include <map>

namespace volumen {

namespace {

QString q(const std::string& s) { return QString::fromStdString(s); }

// A logarithmic axis has no 0; smaller errors are neither visible nor measurable.
double shown(double error) { return std::max(error, 1e-3); }

QString whoAndWhen(const AccuracyStudy& study, const StudyTitle& title) {
  return QStringLiteral("%1  |  scene: %2  |  %6, %7  |  %8\n%3 x %4 pixels, reference at %5")
      .arg(q(title.volume), q(title.scene))
      .arg(study.truth.size.x)
      .arg(study.truth.size.y)
      .arg(q(referenceText(study.truth)), q(title.machine), q(study.kernel), q(title.date));
}

constexpr const char* timeAxis = "median ms a frame";
constexpr const char* errorAxis = "RMSE against the reference, /255";

std::vector<std::string> knobsOf(const AccuracyStudy& study) {
  std::vector<std::string> knobs;
  for (const StudyRow& row : study.rows)
    if (row.setting.knob != "base" && row.setting.knob != "grid" &&
        std::find(knobs.begin(), knobs.end(), row.setting.knob) == knobs.end())
      knobs.push_back(row.setting.knob);
  return knobs;
}

Chart knobPanel(const AccuracyStudy& study, const std::string& knob) {
  Chart chart;
  chart.title = q(knob);
  chart.xTitle = QLatin1String(timeAxis);
  chart.yTitle = QStringLiteral("RMSE, /255");
  ChartSeries others{{}, QColor(205, 209, 216), false, true, {}},
      base{{}, QColor(20, 20, 20), false, false, {}};
  std::map<std::string, ChartSeries> own;  // by method
  for (const StudyRow& row : study.rows) {
    const ChartPoint point{row.medianMs, shown(row.error.rmse), q(row.setting.value), row.front};
    if (row.setting.knob == knob)
      own[row.method].points.push_back(point);
    else if (row.setting.knob == "base")
      base.points.push_back({point.x, point.y, QStringLiteral("base: ") + point.label, row.front});
    else
      others.points.push_back({point.x, point.y, {}, false});
  }
  chart.series = {others};
  for (auto& [method, series] : own) {
    series.colour = methodColour(method);
    series.line = own.size() == 1;
    chart.series.push_back(std::move(series));
  }
  chart.series.push_back(base);
  return chart;
}

}  // namespace

QColor methodColour(const std::string& method) {
  static const std::map<std::string, QColor> colours{
      {"planes", QColor(0, 114, 178)},   {"planes, OpenGL", QColor(86, 180, 233)},
      {"blend", QColor(0, 158, 115)},    {"blend, OpenGL", QColor(120, 200, 90)},
      {"preshaded", QColor(213, 94, 0)}, {"preshaded, OpenGL", QColor(230, 159, 0)},
      {"gpu", QColor(204, 121, 167)}};
  const auto found = colours.find(method);
  return found == colours.end() ? QColor(90, 90, 90) : found->second;
}

Chart errorAgainstTime(const AccuracyStudy& study, const StudyTitle& title) {
  Chart chart;
  chart.title = QStringLiteral("What accuracy costs: every setting's error and time");
  chart.note = whoAndWhen(study, title);
  chart.xTitle = QLatin1String(timeAxis);
  chart.yTitle = QLatin1String(errorAxis);
  chart.frontName = QStringLiteral("front: nothing is faster and better");
  std::map<std::string, ChartSeries> series;
  std::vector<const StudyRow*> front;
  for (const StudyRow& row : study.rows) {
    ChartSeries& s = series[row.method];
    s.name = q(row.method);
    s.colour = methodColour(row.method);
    s.points.push_back({row.medianMs, shown(row.error.rmse), {}, row.front});
    if (row.front) front.push_back(&row);
  }
  std::sort(front.begin(), front.end(),
            [](const StudyRow* a, const StudyRow* b) { return a->medianMs < b->medianMs; });
  // Points that differ by noise alone get one name, the first.
  double named = 1e300;
  for (const StudyRow* row : front) {
    const double error = shown(row->error.rmse);
    chart.front.emplace_back(row->medianMs, error);
    if (error > 0.95 * named) continue;
    named = error;
    ChartSeries& s = series[row->method];
    const auto point = std::find_if(s.points.begin(), s.points.end(), [&](const ChartPoint& c) {
      return c.x == row->medianMs && c.y == error;
    });
    point->label = q(settingName(row->setting));
  }
  for (auto& [name, s] : series) chart.series.push_back(std::move(s));
  return chart;
}

QImage knobPanels(const AccuracyStudy& study, const StudyTitle& title) {
  const auto knobs = knobsOf(study);
  constexpr int columns = 3, width = 620, height = 430, head = 92;
  const int rows = std::max(1, int(knobs.size() + columns - 1) / columns);
  QImage image(columns * width, head + rows * height, QImage::Format_RGB32);
  image.fill(Qt::white);
  QPainter painter(&image);
  QFont font;
  font.setPixelSize(24);
  font.setBold(true);
  painter.setFont(font);
  painter.drawText(QRectF(16, 8, image.width() - 32, 34), Qt::AlignVCenter,
                   QStringLiteral("One knob at a time: error against time, all else as in the base"));
  font.setPixelSize(14);
  font.setBold(false);
  painter.setFont(font);
  painter.drawText(QRectF(16, 42, image.width() - 32, 44), Qt::AlignTop, whoAndWhen(study, title));
  const QRectF span = spanOf(errorAgainstTime(study, title));
  for (std::size_t n = 0; n < knobs.size(); ++n)
    drawChart(painter, QRectF(int(n) % columns * width, head + int(n) / columns * height, width, height),
              knobPanel(study, knobs[n]), span, 13);
  return image;
}

}  // namespace volumen
