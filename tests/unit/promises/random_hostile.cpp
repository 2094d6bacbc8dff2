// The family "hostile": the choice of a kind.
#include "tests/unit/promises/random_hostile.h"

namespace volumen::tests {

RandomCase randomHostile(Chance chance) {
  std::vector<hostile::Kind> kinds;
  for (const auto group : {hostile::curveKinds(), hostile::resonantKinds(), hostile::volumeKinds(),
                           hostile::lightKinds(), hostile::blindSpotKinds()})
    kinds.insert(kinds.end(), group.begin(), group.end());
  RandomCase c;
  const hostile::Kind& kind = kinds[std::size_t(chance.below(int(kinds.size())))];
  c.what = kind.name;
  c.scene.mode = chance.oneIn(10) ? randomMode(chance) : Mode::composite;
  c.size = randomPictureSize(chance);
  kind.make(chance, c);
  return c;
}

}  // namespace volumen::tests
