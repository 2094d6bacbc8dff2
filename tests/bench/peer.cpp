#include "tests/bench/peer.h"

#include <cstdio>
#include <glm/geometric.hpp>
#include <optional>

#include "io/files/picture_file.h"
#include "tests/bench/inputs.h"
#include "viewer/evaluation/statistics.h"
#include "viewer/volume/clock.h"

namespace volumen::bench {

namespace {

constexpr int views = 8;

// Returns options for plain steps of one unit distance along the view, as the peers take them.
RenderOptions oursFor(const Scene& scene, const Volume& volume, int threads, std::optional<double> stopAt) {
  RenderOptions o;
  o.threads = threads;
  o.stopAt = stopAt;
  const glm::dvec3 axis = cameraAxes(*scene.camera).direction;
  o.step = scene.transferFunction.unitDistance * glm::length(volume.geometry().voxelFromPatientStep() * axis);
  return o;
}

std::string inMs(const std::vector<double>& ms) {
  char text[64];
  std::snprintf(text, sizeof text, "%.1f (%.1f)", median(ms), minimum(ms));
  return text;
}

// Times of one renderer per frame: wall clock, and CPU time of all processors, which other programs on the
// machine do not affect.
struct Took {
  std::vector<double> wall, processors;

  template <class Draw>
  double time(bool counts, Draw draw) {
    const double begin = wallMs(), processor = processorMs();
    draw();
    const double ms = wallMs() - begin;
    if (counts) wall.push_back(ms), processors.push_back(processorMs() - processor);
    return ms;
  }
};

class Comparison {
 public:
  Comparison(const Volume& volume, const Scene& scene, RenderCaches& caches, MakePeers makePeers)
      : scene_(scene),
        caches_(caches),
        peers_(makePeers(volume, scene)),
        peersTook_(peers_.size()),
        oursStoppedTook_(peers_.size()),
        firstMs_(peers_.size()) {}

  Status run(const Arguments& a) {
    for (int round = -1; round < a.rounds; ++round)  // the first round warms up
      for (int view = 0; view < views; ++view)
        if (Status s = drawView(view, round >= 0, a.threads); !s) return s;
    return {};
  }

  // Writes the first view as drawn by every renderer.
  Status writePictures(const std::string& folder, const std::string& scene) {
    const auto plan = makePlan(scene_, caches_.facts(), oursFor(scene_, *caches_.volume(), 0, {}));
    const auto ours = plan ? render(*plan, caches_) : Result<Rendered>(plan.error());
    if (!ours) return ours.error();
    if (Status s = writePng(ours->picture, folder + "/" + scene + "-volumen.png", {}); !s) return s;
    for (std::size_t n = 0; n < peers_.size(); ++n) {
      peers_[n]->draw(*scene_.camera);
      Picture picture{{512, 512}, false, {}};
      for (std::size_t k = 0; const std::uint8_t byte : peers_[n]->rgb()) {
        picture.rgba.push_back(float(byte) / 255);
        if (++k % 3 == 0) picture.rgba.push_back(1);
      }
      if (Status s = writePng(picture, folder + "/" + scene + "-peer" + std::to_string(n) + ".png", {}); !s)
        return s;
    }
    return {};
  }

  void print(const std::string& name) const {
    std::printf("| %s | volumen | %s | %s | | | | |\n", name.c_str(), inMs(oursTook_.wall).c_str(),
                inMs(oursTook_.processors).c_str());
    for (std::size_t n = 0; n < peers_.size(); ++n) {
      const Took &peer = peersTook_[n], &stopped = oursStoppedTook_[n];
      std::printf("| %s | %s | %s | %s | %.1f x | %.1f x | %.1f x (1/%.0f: %s) | %.0f |\n", name.c_str(),
                  peers_[n]->name().c_str(), inMs(peer.wall).c_str(), inMs(peer.processors).c_str(),
                  median(peer.wall) / median(oursTook_.wall),
                  median(peer.processors) / median(oursTook_.processors),
                  median(peer.wall) / median(stopped.wall), 1 / peers_[n]->stopsAt(),
                  inMs(stopped.wall).c_str(), firstMs_[n]);
    }
    std::fflush(stdout);
  }

 private:
  Status drawView(int view, bool counts, int threads) {
    Scene scene = scene_;
    scene.camera = turned(*scene_.camera, 360.0 * view / views);
    const auto whole = [&] { return drawOurs(scene, counts, threads, {}, oursTook_); };
    for (std::size_t n = 0; n < peers_.size(); ++n) {
      const auto stopped = [&] {
        return drawOurs(scene, counts, threads, peers_[n]->stopsAt(), oursStoppedTook_[n]);
      };
      // Ours runs before and after the peer equally often, as after it the peer's data fill the caches.
      const bool first = (view + n) % 2 == 0;
      if (Status s = first ? whole() : stopped(); !s) return s;
      const double ms = peersTook_[n].time(counts, [&] { peers_[n]->draw(*scene.camera); });
      if (firstMs_[n] == 0) firstMs_[n] = ms;
      if (Status s = first ? stopped() : whole(); !s) return s;
    }
    return {};
  }

  Status drawOurs(const Scene& scene, bool counts, int threads, std::optional<double> stopAt, Took& took) {
    const auto plan = makePlan(scene, caches_.facts(), oursFor(scene, *caches_.volume(), threads, stopAt));
    if (!plan) return plan.error();
    Status done;
    took.time(counts, [&] {
      if (const auto ours = render(*plan, caches_); !ours) done = ours.error();
    });
    return done;
  }

  const Scene& scene_;
  RenderCaches& caches_;
  std::vector<std::unique_ptr<Peer>> peers_;
  Took oursTook_;
  std::vector<Took> peersTook_, oursStoppedTook_;
  std::vector<double> firstMs_;
};

Status compareAll(const Arguments& a, MakePeers makePeers) {
  const auto volume = readVolume(a.path);
  if (!volume) return volume.error();
  RenderCaches caches(*volume);
  std::printf(
      "| scene | renderer | ms a frame: median (minimum) | of all processors | times as long as volumen | "
      "processors | as volumen whose rays end there too (ms) | first frame ms |\n"
      "|---|---|---|---|---|---|---|---|\n");
  for (const std::string& path : a.scenes) {
    const auto read = readScene(path);
    if (!read) return read.error();
    const auto plan = makePlan(read->scene, caches.facts(), {});
    if (!plan) return plan.error();
    const Scene scene = plan->scene;
    Comparison comparison(**volume, scene, caches, makePeers);
    if (Status s = comparison.run(a); !s) return s;
    comparison.print(read->name);
    if (a.pictures.empty()) continue;
    if (Status s = comparison.writePictures(a.pictures, read->name); !s) return s;
  }
  return {};
}

}  // namespace

int comparePeers(int argc, char** argv, MakePeers makePeers) {
  const auto arguments = readArguments(argc, argv, true);
  const Status done = arguments ? compareAll(*arguments, makePeers) : Status(arguments.error());
  if (!done) std::fprintf(stderr, "%s\n", done.message().c_str());
  return done ? 0 : 1;
}

}  // namespace volumen::bench
