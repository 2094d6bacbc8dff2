#pragma once

#include <QString>
#include <functional>
#include <vector>

#include "ui/widgets/axes.h"

namespace volumen {

/// A tissue's usual CT value.
struct Tissue {
  const char* name;
  double value;  ///< HU
};

constexpr Tissue tissuesHu[] = {{"air", -1000}, {"lung", -700},    {"fat", -100}, {"water", 0},
                                {"muscle", 50}, {"contrast", 200}, {"bone", 400}};

/// A tissue's name and where it begins, in pixels of the axis.
struct TissueLabel {
  QString name;
  double left = 0;
};

/// The names that find room between their own tissue's line and the next one's, `width` pixels wide: none
/// stands where another tissue is.
std::vector<TissueLabel> tissueLabels(const ValueAxis& axis, const std::function<double(QString)>& width);

}  // namespace volumen
