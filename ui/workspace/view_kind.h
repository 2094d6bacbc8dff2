#pragma once

#include <optional>
#include <span>

namespace volumen {

struct Crosshair;
struct PlaneDirections;

/// What a view shows of its series.
enum class ViewKind { volume, axial, coronal, sagittal, frames };

/// What kinds have in common: 3D, slices through a volume, or frames as acquired. The views of a family are
/// widgets of one class.
enum class ViewFamily { scene, slices, frames };

/// The plane of the crosshair that slices lie in.
struct KindPlane {
  PlaneDirections Crosshair::*directions;
  const char* axesText;  ///< for people, where the patient's sides are not known: "Plane xy"
  double wheelSign;      ///< of the way along its normal that the wheel moves down
  unsigned lineColour;   ///< of its line in other slices, 0xRRGGBB
};

/// A kind of view, as far as the program tells kinds apart.
struct KindRow {
  ViewKind kind;
  const char* word;  ///< in session files
  const char* text;  ///< for people
  ViewFamily family;
  const char* action;                ///< that shows it in a view to compare; null: none does
  std::optional<KindPlane> plane{};  ///< of slices, and of nothing else
};

/// All of them, each once.
std::span<const KindRow> viewKinds();
const KindRow& rowOf(ViewKind kind);

/// Whether it is 3D.
bool showsScene(ViewKind kind);
/// Whether it is slices through a volume.
bool showsSlices(ViewKind kind);
/// Whether it is frames as acquired: they are read one by one, and need no volume in memory.
bool showsFrames(ViewKind kind);
/// Whether it is a picture in a plane, as slices and frames are.
bool isFlat(ViewKind kind);

}  // namespace volumen
