#include "ui/views/stack_bar.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

namespace volumen {

namespace {

constexpr double barGap = 2, thinBar = 3, thickBar = 7;  // distance from the view's edge, and widths
constexpr double leastMark = 3;                          // least height of the position mark
const QColor trackColour(255, 255, 255, 40), heldColour(255, 255, 255, 70), placeColour(255, 255, 255, 150),
    keyColour(0xff, 0xc8, 0x5a);

}  // namespace

int StackBar::placeAt(double y) const {
  const int at = int(std::floor((y - area.top()) * place.count / area.height()));
  return std::clamp(at, 0, place.count - 1);
}

QRectF StackBar::partOf(int first, int last) const {
  const double part = area.height() / place.count;
  return {area.left(), area.top() + first * part, area.width(), (last - first + 1) * part};
}

// A line is the stack. What is in memory is as wide as the bar; key images stand out to its left.
void StackBar::paint(QPainter& painter) const {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing, false);
  const double wide = isThick ? thickBar : thinBar, end = area.right() - barGap;
  const auto column = [&](QRectF rows, double width) {
    return QRectF(end - width, rows.top(), width, rows.height());
  };
  painter.fillRect(column(area, 1), trackColour);
  for (const auto& [first, last] : held) painter.fillRect(column(partOf(first, last), wide), heldColour);
  QRectF here = partOf(place.index, place.index);
  if (here.height() < leastMark)
    here = QRectF(here.left(), std::min(here.top(), area.bottom() - leastMark), here.width(), leastMark);
  painter.fillRect(column(here, wide), placeColour);
  for (const int key : keyImages) {
    const double middle = std::round(partOf(key, key).center().y());
    painter.fillRect(QRectF(end - wide - 1, middle - 1, wide + 1, 2), keyColour);
  }
  painter.restore();
}

std::vector<std::pair<int, int>> runsOf(const std::vector<int>& numbers) {
  std::vector<std::pair<int, int>> runs;
  for (const int number : numbers) {
    if (!runs.empty() && runs.back().second + 1 == number)
      runs.back().second = number;
    else
      runs.emplace_back(number, number);
  }
  return runs;
}

}  // namespace volumen
