#include "results/plots/paper_charts.h"

#include "results/plots/picture_image.h"

namespace volumen {

namespace {

const QColor lineColours[] = {{0, 114, 178}, {213, 94, 0},   {0, 158, 115}, {204, 121, 167},
                              {230, 159, 0}, {86, 180, 233}, {90, 90, 90}};

}  // namespace

Chart speedUpByThreads(const PaperBench& bench, const StudyTitle& title) {
  Chart chart;
  chart.title =
      QStringLiteral("Figure 9 again: speed-up by threads (Planes, 128 x 128 pixels, 84 samples a ray)");
  chart.note = QString::fromStdString(title.machine + ", " + bench.kernel + "  |  " + title.date);
  chart.xTitle = QStringLiteral("threads");
  chart.yTitle = QStringLiteral("times as fast as one thread");
  chart.logarithmic = false;
  chart.wholeX = true;
  ChartSeries ideal{QStringLiteral("as fast as N threads can be"), QColor(190, 195, 203), true, true, {}};
  for (int n = 0; n < int(bench.volumes.size()); ++n) {
    ChartSeries s{QString::fromStdString(bench.volumes[n].name),
                  lineColours[n % std::size(lineColours)],
                  true,
                  false,
                  {}};
    double one = 0;
    for (const PaperThreads& t : bench.threads) {
      if (t.volume != n) continue;
      if (t.threads == 1) one = t.medianMs;
      s.points.push_back({double(t.threads), one / t.medianMs, {}, false});
      if (n == 0) ideal.points.push_back({double(t.threads), double(t.threads), {}, false});
    }
    chart.series.push_back(std::move(s));
  }
  chart.series.insert(chart.series.begin(), std::move(ideal));
  return chart;
}

QImage figure3Image(const PaperFigure3& figure) {
  const QImage pictures[] = {imageOf(figure.direct), imageOf(figure.table)};
  const int edge = pictures[0].width(), gap = 12, caption = 40;
  QImage image(2 * edge + 3 * gap, edge + gap + caption, QImage::Format_RGB32);
  image.fill(Qt::white);
  QPainter painter(&image);
  QFont font;
  font.setPixelSize(18);
  painter.setFont(font);
  const char* names[] = {"(a) lit directly, 8 bits a component", "(b) from the 4-index table of 5 bits each"};
  for (int n = 0; n < 2; ++n) {
    const int x = gap + n * (edge + gap);
    painter.drawImage(x, gap, pictures[n]);
    painter.drawText(QRectF(x, gap + edge, edge, caption), Qt::AlignCenter, QLatin1String(names[n]));
  }
  return image;
}

}  // namespace volumen
