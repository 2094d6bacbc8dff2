#pragma once

#include <memory>
#include <string>
#include <vector>

#include "viewer/render/render.h"

namespace volumen::bench {

/// Another volume renderer, or one of its ways, on the volume and scene of ours.
class Peer {
 public:
  virtual ~Peer() = default;
  virtual std::string name() const = 0;
  /// The transmittance below which it follows a ray no further.
  virtual double stopsAt() const = 0;
  /// Draws the scene from this (complete) camera.
  virtual void draw(const Camera& camera) = 0;
  /// What it drew last: 512 x 512 RGB bytes, first row on top.
  virtual std::vector<std::uint8_t> rgb() const = 0;
};

/// Makes the peers for a scene; called once a scene, not timed. What they make when they draw for the first
/// time is told apart.
using MakePeers = std::vector<std::unique_ptr<Peer>> (*)(const Volume& volume, const Scene& scene);

/// The 8-view orbit (the camera of the scene turned about its up axis by 45 degrees each) at 512 x 512, one
/// sample every unit distance, all in one run: in every round each view is drawn by each peer, by us, and by
/// us with rays that end where that peer's do.
/// Arguments: PATH SCENE.json... [--rounds N] [--threads N] [--pictures FOLDER]: the first views, to see that
/// all draw the same. A Markdown table of median (minimum) ms and ratios on stdout; returns the exit status.
int comparePeers(int argc, char** argv, MakePeers makePeers);

}  // namespace volumen::bench
