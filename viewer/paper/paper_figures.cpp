// The paper's measurements (Tables 1 and 2) and its phantoms.
#include "viewer/paper/paper.h"
#include "viewer/phantoms/phantoms.h"

namespace volumen {

const std::array<PaperPicture, 5> paperPictures{{{128, 84}, {200, 0}, {200, 200}, {400, 128}, {512, 0}}};

const std::array<const char*, paperVolumes> paperVolumeNames{
    "translucent solid", "translucent sphere", "opaque sphere", "lobster", "silicon", "MRI head", "CT head"};

double paperSeconds(Method method, int picture, int volume) {
  static constexpr double planes[5][paperVolumes] = {{1.04, 0.54, 0.19, 0.24, 0.48, 0.36, 0.20},
                                                     {1.90, 0.99, 0.35, 0.31, 0.52, 1.27, 0.48},
                                                     {5.55, 2.69, 0.73, 1.22, 2.21, 1.76, 0.67},
                                                     {13.19, 6.10, 1.84, 2.78, 5.98, 4.53, 1.84},
                                                     {11.96, 6.15, 1.94, 1.88, 3.06, 7.99, 2.81}};
  static constexpr double blend[5][paperVolumes] = {{0.83, 0.48, 0.48, 0.26, 0.46, 0.35, 0.29},
                                                    {1.48, 0.88, 0.83, 0.23, 0.38, 1.21, 0.84},
                                                    {4.64, 2.63, 2.66, 1.31, 2.50, 1.83, 1.49},
                                                    {11.30, 5.40, 3.19, 3.04, 5.13, 13.49, 3.44},
                                                    {9.29, 5.46, 5.14, 1.32, 2.36, 7.26, 4.68}};
  return (method == Method::planes ? planes : blend)[picture][volume];
}

std::vector<PaperVolume> paperPhantoms() {
  struct Phantom {
    const char* name;
    double opacity;
  };
  std::vector<PaperVolume> out;
  for (const Phantom& p :
       {Phantom{"solid:64", 1.0 / 255}, {"sphere:64", 4.0 / 255}, {"opaque-sphere:64", 1.0}}) {
    PaperVolume v;
    v.column = int(out.size());
    v.name = std::string("phantom:") + p.name;
    v.volume = *makePhantom(p.name);
    // Voxels are 1 mm, so opacity per voxel is opacity per unit distance.
    v.scene.transferFunction.points = {{0, {1, 0.9, 0.8}, 0}, {1, {1, 0.9, 0.8}, p.opacity}};
    out.push_back(std::move(v));
  }
  return out;
}

Result<PaperFigure3> drawFigure3(int edge) {
  RenderCaches caches(*makePhantom("soft-sphere:64"));
  Scene scene;
  scene.transferFunction.points = {{400, {1, 1, 1}, 0}, {600, {1, 1, 1}, 1}};
  scene.lights[0].direction = {-0.5, 0.6, 0.8};
  scene.shading.specular = 0.4;
  const auto draw = [&](Shader shader) -> Result<Picture> {
    RenderOptions options;
    options.size = {edge, edge};
    options.step = 1.0 / 8;
    options.shader = shader;
    const auto plan = makePlan(scene, caches.facts(), options);
    if (!plan) return plan.error();
    auto done = render(*plan, caches);
    if (!done) return done.error();
    return std::move(done->picture);
  };
  auto direct = draw(Shader::phong);
  if (!direct) return direct.error();
  auto table = draw(Shader::table);
  if (!table) return table.error();
  return PaperFigure3{std::move(*direct), std::move(*table)};
}

}  // namespace volumen
