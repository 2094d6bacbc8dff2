#include "io/study/choose.h"

#include <algorithm>
#include <charconv>

#include "io/study/study.h"

namespace volumen {

Result<std::size_t> chooseSeries(const Study& study, const std::string& text) {
  const std::vector<Series>& all = study.volumes;
  if (all.empty()) return Error{"There is no series to choose from."};
  if (text.empty()) {
    const auto most = std::max_element(all.begin(), all.end(), [](const Series& a, const Series& b) {
      return a.acquired.voxelCount() < b.acquired.voxelCount();
    });
    return std::size_t(most - all.begin());
  }
  for (std::size_t n = 0; n < all.size(); ++n)
    if (all[n].id == text) return n;
  for (std::size_t n = 0; n < all.size(); ++n)
    if (all[n].seriesUid == text) return n;
  std::size_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error == std::errc() && stop == end && number >= 1 && number <= all.size()) return number - 1;
  return Error{"Unknown series \"" + text + "\"."};
}

}  // namespace volumen
