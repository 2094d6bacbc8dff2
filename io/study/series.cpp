#include "io/study/series.h"

#include <algorithm>
#include <utility>

namespace volumen {

void setProjections(Series& series, std::vector<ProjectionView> ofEach) {
  series.projections.clear();
  if (ofEach.empty()) return;
  const ProjectionView first = ofEach.front();
  const auto agree = [&](std::string ProjectionView::*what) {
    return std::ranges::all_of(ofEach, [&](const ProjectionView& p) { return p.*what == first.*what; });
  };
  const bool ofOneSide = agree(&ProjectionView::laterality), ofOneView = agree(&ProjectionView::viewPosition);
  series.laterality = ofOneSide ? first.laterality : std::string();
  series.viewPosition = ofOneView ? first.viewPosition : std::string();
  if (!ofOneSide || !ofOneView) series.projections = std::move(ofEach);
}

ProjectionView projectionOf(const Series& series, int frame) {
  if (frame < 0 || frame >= int(series.projections.size())) return {series.laterality, series.viewPosition};
  return series.projections[std::size_t(frame)];
}

bool CurvedFrom::operator==(const CurvedFrom& other) const {
  return (source == other.source || *source == *other.source) && recipe == other.recipe && name == other.name;
}

}  // namespace volumen
