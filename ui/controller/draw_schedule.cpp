#include "ui/controller/draw_schedule.h"

#include <algorithm>
#include <tuple>

namespace volumen {

std::optional<Turn> nextTurn(const Waiting& waiting) {
  // The smallest rank is drawn first.
  const auto rank = [&](const WaitingView& v) {
    const bool overdue = v.next == Work::draft && v.waited > longestWait;
    return std::tuple(v.next, !overdue, overdue || v.view != waiting.gestureView, -v.waited, v.view);
  };
  const auto first =
      std::min_element(waiting.views.begin(), waiting.views.end(),
                       [&](const WaitingView& a, const WaitingView& b) { return rank(a) < rank(b); });
  if (first != waiting.views.end()) return Turn{first->next, first->view};
  if (waiting.saved) return Turn{Work::saved};
  if (waiting.trial) return Turn{Work::trial};
  if (waiting.thumbnail) return Turn{Work::thumbnail};
  return {};
}

}  // namespace volumen
