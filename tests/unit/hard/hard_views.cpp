// Hard views: eyes and rays exactly on planes of the grid, fields of view, clips down to nothing, picture
// sizes.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/hard/hard_cases.h"

namespace volumen::tests {
namespace {

using glm::dmat3;
using glm::dvec3;
using glm::dvec4;
using glm::ivec3;

HardCase overWaves(const std::string& name) {
  const VolumePtr volume = wavesVolume();
  return {.name = name, .volume = volume, .scene = sceneOf(*volume, softCurve(0, 1000)), .delicate = true};
}

/// Returns a case over a cube of 8 voxels of 1 mm that absorbs one tenth per mm.
HardCase overCube(const std::string& name, dvec3 direction) {
  static const VolumePtr volume = volumeOf(ivec3(8), dmat3(1), [](dvec3) { return 40; });
  HardCase c{.name = name,
             .volume = volume,
             .scene = sceneOf(*volume, {{0, {0.9, 0.5, 0.3}, 0.1}}, direction),
             .uniform = true,
             .delicate = true};
  c.scene.shading.lit = false;
  c.scene.background.transparent = true;
  c.closedForm = [](double mm) {
    const double alpha = 1 - std::pow(0.9, mm);
    return dvec4(dvec3(0.9, 0.5, 0.3) * alpha, alpha);
  };
  return c;
}

void lookFrom(Camera& camera, dvec3 eye, dvec3 direction, double fov) {
  camera.projection = Projection::perspective;
  camera.direction = direction;
  camera.distance = 4;
  camera.target = eye + 4.0 * glm::normalize(direction);
  camera.fov = fov;
}

void addEyes(HardCases& cases) {
  const VoxelGeometry g = wavesVolume()->geometry();
  const auto eye = [&](const std::string& name, dvec3 pVoxel, dvec3 direction) {
    HardCase c = overWaves(name);
    lookFrom(*c.scene.camera, g.patientFromVoxel(pVoxel), direction, 75);
    cases.add(c);
  };
  eye("eye inside", {9.3, 8.7, 7.1}, {0.3, 0.8, -0.2});
  eye("eye on a voxel, looking along the grid", {10, 9, 8}, {0, 1, 0});
  eye("eye on a voxel plane, looking in it", {10, 9, 8.5}, {1, 0.001, 0});
  eye("eye on the face of the box, looking in", {10, -0.5, 8}, {0, 1, 0});
  eye("eye on the face of the box, looking out", {10, -0.5, 8}, {0, -1, 0});
  eye("eye on the corner of the box", {-0.5, -0.5, -0.5}, {1, 1, 1});
  HardCase c = overWaves("eye inside, local viewer");
  lookFrom(*c.scene.camera, g.patientFromVoxel({9.3, 8.7, 7.1}), {0.3, 0.8, -0.2}, 75);
  c.scene.shading.localViewer = true;
  cases.add(c);
  c = overCube("eye in the middle of a cube", {0, 1, 0});
  lookFrom(*c.scene.camera, dvec3(0), {0, 1, 0}, 75);
  cases.add(c);
}

void addFieldsOfView(HardCases& cases) {
  for (double fov : {0.1, 1.0, 150.0})
    for (HardCase c : {overWaves(""), overCube("", {-0.5, 0.7, -0.4})}) {
      c.name = "fov " + std::to_string(fov).substr(0, 5) + (c.closedForm ? ", cube" : ", waves");
      Camera& camera = *c.scene.camera;
      camera.projection = Projection::perspective;
      camera.fov = fov;
      camera.distance = camera.height / 2 / std::tan(glm::radians(fov) / 2);
      cases.add(c);
    }
}

void addRays(HardCases& cases) {
  HardCase c = overCube("rays along the grid, on the planes of its voxels", {0, 1, 0});
  c.size = {8, 8};
  c.scene.camera->height = 8;
  cases.add(c);
  c.name = "rays parallel to faces, on the faces and on the box: inside";
  c.size = {9, 9};
  c.scene.camera->height = 9;
  cases.add(c);
  c.scene.clip.planes = {{{0, 0, 2}, 4}, {{-1, 0, 0}, 4}, {{0, 0, -1}, 4}};
  c.name = "rays on clip planes that are the box's faces: inside";
  cases.add(c);
  cases.addBoth(overCube("rays along the diagonal", {1, 1, 1}));
  HardCase onWaves = overWaves("rays along the grid, on the planes of its voxels, waves");
  onWaves.scene.camera->direction = {0, 1, 0};
  onWaves.size = {16, 16};
  onWaves.scene.camera->height = 16 * 1.25;
  cases.addBoth(onWaves);

  const VolumePtr slice = volumeOf({18, 16, 1}, dmat3(1), [](dvec3 x) { return 1000 * waves(x); });
  HardCase edge{.name = "one slice, edge-on",
                .volume = slice,
                .scene = sceneOf(*slice, softCurve(0, 1000), {1, 0.2, 0}),
                .delicate = true};
  edge.scene.camera->height = 3;
  cases.addBoth(edge);
  edge.name = "one slice, edge-on, rays in its faces";
  edge.scene.camera->direction = {1, 0, 0};
  edge.size = {3, 3};
  cases.add(edge);
}

void addClips(HardCases& cases) {
  const auto both = [&](const std::string& name, const Clip& clip) {
    HardCase wavy = overWaves(name + ", waves"), cube = overCube(name + ", cube", {-0.5, 0.7, -0.4});
    for (HardCase* c : {&wavy, &cube}) {
      c->scene.clip = clip;
      cases.addBoth(*c);
    }
  };
  both("clip box of one voxel", {dvec3(4, 4, 4) / 8.0, dvec3(5, 5, 5) / 8.0, {}});
  both("clip box of a thousandth", {{0.5, 0.2, 0.2}, {0.501, 0.9, 0.9}, {}});
  both("clip box of nothing", {dvec3(0.5), dvec3(0.5), {}});
  both("clip box flat, of no thickness", {{0, 0.5, 0}, {1, 0.5, 1}, {}});
  both("clip planes that cut everything", {dvec3(0), dvec3(1), {{{0, 0, 1}, -100}}});
  both("clip planes that exclude each other", {dvec3(0), dvec3(1), {{{0, 1, 0}, -1}, {{0, -1, 0}, -1}}});
  both("clip planes that meet", {dvec3(0), dvec3(1), {{{0, 1, 0}, 1}, {{0, -1, 0}, -1}}});
  both("clip planes that overlap", {dvec3(0.1),
                                    dvec3(0.9),
                                    {{{1, 1, 0}, 1},
                                     {{1, 1, 0}, 1},
                                     {{1, 1, 1e-9}, 1},
                                     {{2, 2, 0}, 1.5},
                                     {{-1, 0, 0}, 2},
                                     {{0, 0, 1}, 3}}});
  both("clip planes nearly parallel to the rays", {dvec3(0), dvec3(1), {{{0.7, 0.5, 1e-4}, 0.1}}});
}

void addPictures(HardCases& cases) {
  for (const auto& [name, size] : {std::pair{"picture of one pixel", glm::ivec2(1, 1)},
                                   {"picture of 7 x 5", {7, 5}},
                                   {"picture of 1 x 37", {1, 37}}}) {
    HardCase c = overWaves(name);
    c.size = size;
    cases.addBoth(c);
  }
  for (const auto& [name, factor] : {std::pair{"hundred-fold zoom in", 0.01}, {"zoom in 10^5-fold", 1e-5}}) {
    HardCase c = overWaves(name);
    c.scene.camera->height *= factor;
    cases.addBoth(c);
  }
  HardCase c = overCube("hundred-fold zoom out, cube", {-0.5, 0.7, -0.4});
  c.size = {31, 31};  // the middle pixel's ray meets it
  c.scene.camera->height *= 100;
  cases.addBoth(c);
  c = overWaves("hundred-fold zoom out");
  c.size = {301, 301};
  c.scene.camera->height *= 100;
  cases.addBoth(c);
  c = overCube("picture of 8192 x 64", {-0.5, 0.7, -0.4});
  c.size = {8192, 64};
  cases.add(c);
}

}  // namespace

void addViewCases(HardCases& cases) {
  addEyes(cases);
  addFieldsOfView(cases);
  addRays(cases);
  addClips(cases);
  addPictures(cases);
}

}  // namespace volumen::tests
