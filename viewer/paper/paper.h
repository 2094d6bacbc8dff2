#pragma once

#include <array>

#include "viewer/evaluation/accuracy_study.h"
#include "viewer/evaluation/progress.h"
#include "viewer/render/render.h"

namespace volumen {

// Measures tables 1 and 2, Figure 9 and section 4 of the paper on this machine (`bench --paper`).

/// One of the five pictures of the tables: W x W pixels and samples per ray (0: one per voxel, "volume
/// depth").
struct PaperPicture {
  int width = 0, samples = 0;
  bool operator==(const PaperPicture&) const = default;
};
extern const std::array<PaperPicture, 5> paperPictures;

/// The seven volumes of the tables, in order: the three phantoms, lobster, silicon, MRI head, CT head.
constexpr int paperVolumes = 7;
extern const std::array<const char*, paperVolumes> paperVolumeNames;

/// Returns the paper's time in s for algorithm 1 (Planes) or 2 (Blend), by picture and volume.
double paperSeconds(Method method, int picture, int volume);

/// A volume to measure: the paper's own phantom, or a substitute for one of its scans.
struct PaperVolume {
  int column = 0;    ///< Column in the paper's tables.
  std::string name;  ///< Name of the volume actually used.
  VolumePtr volume;
  Scene scene;
};

/// Returns the three phantoms exactly as in the paper: 64^3, opacity 1/255, 4/255 and 1 per voxel, lit.
std::vector<PaperVolume> paperPhantoms();

struct PaperCell {
  Method method = Method::planes;
  int picture = 0, volume = 0;  ///< Indices into paperPictures and the measured volumes.
  double medianMs = 0, minimumMs = 0;
};

/// Time by number of threads: 128 x 128 pixels, 84 samples (Figure 9).
struct PaperThreads {
  int volume = 0, threads = 1;
  double medianMs = 0;
};

/// Time for one size of the opaque sphere: 100 x 100 pixels, 100 samples.
struct PaperSize {
  int edge = 0;
  double medianMs = 0;
};

/// A method of the paper's section 4, on one scene.
struct PaperRival {
  std::string name, what;
  double medianMs = 0;
  PictureError own;      ///< Error against the reference of the picture that the method means to draw.
  PictureError against;  ///< Error against the reference of the lit, translucent picture.
};

struct PaperBench {
  std::vector<PaperVolume> volumes;
  std::vector<PaperCell> cells;
  std::vector<PaperThreads> threads;
  std::vector<PaperSize> sizes;
  std::vector<PaperRival> rivals;
  std::string rivalsOn;  ///< Volume and picture used for the rivals.
  std::string kernel;
};

struct PaperOptions {
  int rounds = 5;   ///< Frames per figure, interleaved.
  int threads = 0;  ///< Threads for the tables; 0: all allowed.
};

/// Measures everything on `volumes` (the phantoms first). Returns an Error "cancelled" or the renderer's.
Result<PaperBench> measurePaper(std::vector<PaperVolume> volumes, const PaperOptions& options,
                                const StudyProgress& progress = {}, const CancelToken& cancel = {});

/// Returns all tables as Markdown, for people.
std::string paperText(const PaperBench& bench, const std::string& machine, const std::string& date);
/// Returns the cells of Tables 1 and 2: method, picture, volume, ms, the paper's seconds, speed-up.
std::string paperTablesCsv(const PaperBench& bench);
/// Returns Figure 9: volume, threads, ms, speed-up.
std::string paperThreadsCsv(const PaperBench& bench);
/// Returns section 4: method, ms, errors.
std::string paperRivalsCsv(const PaperBench& bench);

/// Figure 3: a sphere lit directly with 8 bits per component, next to the 4-index 5-bit table.
struct PaperFigure3 {
  Picture direct, table;
};
Result<PaperFigure3> drawFigure3(int edge);

}  // namespace volumen
