// Parts that the kinds of the family "hostile" share.
#include "tests/unit/promises/random_hostile.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <memory>

#include "tests/fixtures/small_volumes.h"

namespace volumen::tests::hostile {

using glm::dmat3;
using glm::dvec3;
using glm::ivec3;

namespace {

/// Returns three perpendicular unit vectors: the axes of the grid, or turned ones.
dmat3 anyTurn(Chance& chance) {
  if (chance.oneIn(3)) return dmat3(1);
  const dvec3 first = anyDirection(chance);
  const dvec3 second = glm::normalize(glm::cross(first, chance.vector()));
  return {first, second, glm::cross(first, second)};
}

/// Values of a grid, painted one thing after another.
struct Painted {
  ivec3 size;
  std::vector<float> values = std::vector<float>(std::size_t(size.x) * size.y * size.z);

  float& at(ivec3 x) { return values[(std::size_t(x.z) * size.y + x.y) * std::size_t(size.x) + x.x]; }
  void addBall(dvec3 centre, double radius) {
    const ivec3 low = glm::max(ivec3(centre - radius - 1.0), ivec3(0));
    const ivec3 high = glm::min(ivec3(centre + radius + 2.0), size - 1);
    for (int k = low.z; k <= high.z; ++k)
      for (int j = low.y; j <= high.y; ++j)
        for (int i = low.x; i <= high.x; ++i) {
          const double share = radius + 0.5 - glm::distance(dvec3(i, j, k), centre);
          at({i, j, k}) = std::max(at({i, j, k}), float(std::clamp(share, 0.0, 1.0)));
        }
  }
};

}  // namespace

ValueAt plates(dvec3 normal, double period, double thick) {
  return [=](dvec3 x) {
    const double off = std::abs(std::remainder(glm::dot(x, normal), period));
    return std::clamp(thick / 2 + 0.5 - off, 0.0, 1.0);
  };
}

ValueAt anyLattice(Chance& chance) {
  const double period = chance.oneIn(2) ? 2 + chance.below(11) : chance.between(2, 12);
  const double thick = chance.oneIn(2) ? 1 : chance.between(0.7, 1.6);
  const int kind = chance.below(4);
  if (kind == 0) {  // plates with whole numbers of voxels along each axis between them
    const dvec3 normal(chance.below(3), chance.below(4), 1 + chance.below(3));
    return plates(normal, std::round(period), thick);
  }
  const dmat3 turn = anyTurn(chance);
  return [=](dvec3 x) {
    dvec3 off = x * turn;
    for (int a = 0; a < 3; ++a) off[a] = a < kind ? std::remainder(off[a], period) : 0;
    return std::clamp(thick / 2 + 0.5 - glm::length(off), 0.0, 1.0);
  };
}

ValueAt ripples(Chance& chance, double period, int count) {
  std::vector<std::pair<dvec3, double>> waves;
  for (int n = 0; n < count; ++n) {
    const dvec3 direction = glm::normalize(chance.vector());
    const double length = period * chance.between(0.7, 1.4);
    waves.push_back({direction * (2 * M_PI / length), chance.between(0, 2 * M_PI)});
  }
  return [=](dvec3 x) {
    double sum = 0;
    for (const auto& [wave, phase] : waves) sum += std::cos(glm::dot(x, wave) + phase);
    return 0.5 + 0.5 * sum / count;
  };
}

ValueAt hill(ivec3 size) {
  return [=](dvec3 x) {
    const dvec3 from = (2.0 * x - dvec3(size - 1)) / dvec3(size);
    return std::max(0.0, 1 - glm::dot(from, from));
  };
}

ValueAt sponge(Chance& chance, ivec3 size, int count) {
  const auto painted = std::make_shared<Painted>(Painted{size});
  for (int n = 0; n < count; ++n) {
    const dvec3 centre = (chance.vector() * 0.5 + 0.5) * dvec3(size - 1);
    painted->addBall(centre, chance.between(1.5, 4));
  }
  return [painted](dvec3 x) { return double(painted->at(ivec3(x))); };
}

ValueAt network(Chance& chance) {
  const double turn = 2 * M_PI / chance.between(5, 11), phase = chance.between(0, 6);
  return [=](dvec3 x) {
    const dvec3 p = x * turn + phase;
    return (std::sin(p.x) * std::cos(p.y) + std::sin(p.y) * std::cos(p.z) + std::sin(p.z) * std::cos(p.x)) /
           1.5;
  };
}

ValueAt ctValues(Chance& chance, ivec3 size, double noiseHu) {
  const ValueAt body = ball(size, 0.42);
  const ValueAt organs = ripples(chance, chance.between(9, 25), 6);
  const ValueAt bones = ripples(chance, chance.between(5, 12), 3);
  const ValueAt grain = noise(chance);
  return [=](dvec3 x) {
    const double tissue = -150 + 350 * organs(x);
    const double bone = 1500 * std::clamp((bones(x) - 0.7) * 8, 0.0, 1.0);
    return std::min(2000.0, -1000 + body(x) * (1000 + tissue + bone) + noiseHu * (grain(x) - 0.5));
  };
}

dvec3 anyDirection(Chance& chance) {
  if (chance.oneIn(2)) return directionOfSmallNumbers(chance);
  return glm::normalize(chance.vector());
}

dvec3 nearly(Chance& chance, dvec3 direction) {
  if (chance.oneIn(2)) return direction;
  const double off = chance.power(-5, -1);
  return direction + off * chance.vector();
}

void lookAlong(Chance& chance, RandomCase& c, dvec3 direction, double share) {
  Camera camera;
  camera.direction = direction;
  camera.up = chance.vector();
  camera = fitCamera(camera, c.volume->geometry(), 1);
  camera.height *= share;
  c.scene.camera = camera;
}

void lookFromInside(Chance& chance, RandomCase& c) {
  const VoxelGeometry& g = c.volume->geometry();
  Camera camera;
  camera.direction = anyDirection(chance);
  camera.up = chance.vector();
  camera.projection = Projection::perspective;
  camera.fov = chance.between(30, 150);
  camera.distance = voxelEdgeOf(g) * chance.power(-2, 0.5);
  camera.target = g.centre() + 0.3 * radiusOf(g) * chance.vector();
  c.scene.camera = camera;
}

void setDepth(RandomCase& c, double opacity, double depth) {
  const double across = 2 * radiusOf(c.volume->geometry());
  c.scene.transferFunction.unitDistance = -std::log1p(-std::min(opacity, 0.999)) * across / depth;
}

std::vector<CurvePoint> comb(ValueRange range, int count, CurvePoint even, CurvePoint odd) {
  std::vector<CurvePoint> points;
  for (int n = 0; n < count; ++n) {
    points.push_back(n % 2 ? odd : even);
    points.back().value = valueIn(range, n / double(count - 1));
  }
  return points;
}

std::vector<CurvePoint> anyComb(Chance& chance, ValueRange range, int count, double most) {
  CurvePoint even{0, dvec3(0), most}, odd{0, dvec3(1), most};
  switch (chance.below(4)) {
    case 0:  // opacity alone
      odd.colour = even.colour = chance.colour();
      even.opacity = 0;
      break;
    case 1:  // small changes of opacity
      odd.colour = even.colour = dvec3(1);
      even.opacity = most * chance.between(0.5, 0.98);
      break;
    case 2:  // colours and opacity
      even.opacity = most * chance.share();
      break;
    default:  // black and white
      break;
  }
  return comb(range, count, even, odd);
}

void aroundCt(Chance& chance, RandomCase& c, double noiseHu) {
  const ivec3 size = anySize(chance, 24, 96);
  dvec3 mm(chance.between(0.5, 1));
  mm.y = mm.x;
  mm.z = chance.between(0.5, 3);
  const ValueAt values = ctValues(chance, size, noiseHu);
  around(chance, c,
         volumeOf<std::int16_t>(size, spacing(mm), [&](dvec3 x) { return std::round(values(x)); }));
}

}  // namespace volumen::tests::hostile
