#pragma once

namespace volumen {

/// A tissue's usual CT value.
struct Tissue {
  const char* name;
  double value;  ///< HU
};

constexpr Tissue tissuesHu[] = {{"air", -1000}, {"lung", -700},    {"fat", -100}, {"water", 0},
                                {"muscle", 50}, {"contrast", 200}, {"bone", 400}};

}  // namespace volumen
