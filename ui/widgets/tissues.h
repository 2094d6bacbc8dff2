#pragma once

#include <QString>
#include <functional>
#include <vector>

#include "ui/widgets/axes.h"

namespace volumen {

/// The usual CT value of a tissue.
struct Tissue {
  const char* name;
  double value;  ///< HU
};

constexpr Tissue tissuesHu[] = {{"air", -1000}, {"lung", -700},    {"fat", -100}, {"water", 0},
                                {"muscle", 50}, {"contrast", 200}, {"bone", 400}};

/// A tissue's name and its left edge in pixels of the axis.
struct TissueLabel {
  QString name;
  double left = 0;
};

/// Returns the names that fit between their own tissue's line and the next one, `width` pixels wide.
std::vector<TissueLabel> tissueLabels(const ValueAxis& axis, const std::function<double(QString)>& width);

}  // namespace volumen
