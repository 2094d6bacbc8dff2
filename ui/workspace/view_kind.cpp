#include "ui/workspace/view_kind.h"

#include <algorithm>

#include "ui/workspace/workspace.h"

namespace volumen {

namespace {

// Unturned, a wheel step down goes to caudal, posterior and left.
constexpr KindRow kinds[] = {
    {ViewKind::volume, "volume", "3D", ViewFamily::scene, "show3D"},
    {ViewKind::axial,
     "axial",
     "Axial",
     ViewFamily::slices,
     "showAxial",
     {{&Crosshair::axial, "Plane xy", -1, 0xff5c5c}}},
    {ViewKind::coronal,
     "coronal",
     "Coronal",
     ViewFamily::slices,
     "showCoronal",
     {{&Crosshair::coronal, "Plane xz", 1, 0x5ce07a}}},
    {ViewKind::sagittal,
     "sagittal",
     "Sagittal",
     ViewFamily::slices,
     "showSagittal",
     {{&Crosshair::sagittal, "Plane yz", -1, 0xf5d94a}}},
    {ViewKind::frames, "frames", "Frames", ViewFamily::frames, nullptr},
};

}  // namespace

std::span<const KindRow> viewKinds() { return kinds; }

const KindRow& rowOf(ViewKind kind) { return *std::ranges::find(kinds, kind, &KindRow::kind); }

bool showsScene(ViewKind kind) { return rowOf(kind).family == ViewFamily::scene; }

bool showsSlices(ViewKind kind) { return rowOf(kind).family == ViewFamily::slices; }

bool showsFrames(ViewKind kind) { return rowOf(kind).family == ViewFamily::frames; }

bool isFlat(ViewKind kind) { return showsSlices(kind) || showsFrames(kind); }

}  // namespace volumen
