#pragma once

#include <memory>
#include <string>
#include <vector>

#include "viewer/render/render.h"

namespace volumen::bench {

/// Another volume renderer, or one of its methods, with our volume and scene.
class Peer {
 public:
  virtual ~Peer() = default;
  virtual std::string name() const = 0;
  /// Returns the transmittance below which it ends rays.
  virtual double stopsAt() const = 0;
  /// Draws the scene from this (complete) camera.
  virtual void draw(const Camera& camera) = 0;
  /// Returns the last picture: 512 x 512 RGB bytes, top row first.
  virtual std::vector<std::uint8_t> rgb() const = 0;
};

/// Makes the peers for a scene. Called once per scene and not timed. Work of the peers at their first drawing
/// is reported separately.
using MakePeers = std::vector<std::unique_ptr<Peer>> (*)(const Volume& volume, const Scene& scene);

/// Compares the peers with us on an 8-view orbit (the scene's camera rotated about its up axis in steps of 45
/// degrees) at 512 x 512. Takes one sample per unit distance. In each round each view is drawn by each peer,
/// by us, and by us with rays that end where that peer's do.
/// Arguments: PATH SCENE.json... [--rounds N] [--threads N] [--pictures FOLDER]. The folder gets the first
/// views, to check that all draw the same. Prints a Markdown table of median (minimum) ms and ratios, and
/// returns the exit status.
int comparePeers(int argc, char** argv, MakePeers makePeers);

}  // namespace volumen::bench
