#pragma once

#include <optional>
#include <span>

namespace volumen {

struct Crosshair;
struct PlaneDirections;

/// The content of a view.
enum class ViewKind { volume, axial, coronal, sagittal, frames };

/// Families of kinds: 3D, slices through a volume, or frames as acquired. All views of a family are widgets
/// of one class.
enum class ViewFamily { scene, slices, frames };

/// The plane of the crosshair that slices lie in.
struct KindPlane {
  PlaneDirections Crosshair::*directions;
  const char* axesText;  ///< for people, if the patient's sides are unknown: "Plane xy"
  double wheelSign;      ///< sign of a wheel step down along its normal
  unsigned lineColour;   ///< colour of its line in other slices, 0xRRGGBB
};

/// A kind of view, with all that distinguishes it from others.
struct KindRow {
  ViewKind kind;
  const char* word;  ///< in session files
  const char* text;  ///< for people
  ViewFamily family;
  const char* action;                ///< shows it in a comparison view; null: none does
  std::optional<KindPlane> plane{};  ///< for slices only
};

/// Returns all kinds, each once.
std::span<const KindRow> viewKinds();
const KindRow& rowOf(ViewKind kind);

/// Returns whether a kind is 3D.
bool showsScene(ViewKind kind);
/// Returns whether a kind is slices through a volume.
bool showsSlices(ViewKind kind);
/// Returns whether a kind is frames as acquired, which are read one by one and need no volume in memory.
bool showsFrames(ViewKind kind);
/// Returns whether a kind is a picture in a plane: slices or frames.
bool isFlat(ViewKind kind);

}  // namespace volumen
