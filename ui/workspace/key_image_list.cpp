#include "ui/workspace/key_image_list.h"

#include "io/study/frame_series.h"
#include "results/text/text.h"
#include "ui/data/picture_index.h"
#include "ui/workspace/derived_text.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/key_images.h"

namespace volumen {

namespace {

KeyImageGroup markedHere(const Workspace& workspace) {
  KeyImageGroup group{tr("Marked here"), false, {}, 0};
  for (const KeyImage& image : workspace.keyImages) {
    const auto state = workspace.series.find(image.series);
    if (state == workspace.series.end()) continue;
    const ReferencedPicture picture{image.sopInstanceUid, {}, {image.frame}, {}};
    const std::vector<int> named = picturesNamed({picture}, *state->second.series);
    if (!named.empty()) group.pictures.push_back({state->second.series, named.front(), image.window});
  }
  return group;
}

KeyImageGroup markedIn(const DerivedObject& document, const std::vector<const Series*>& open) {
  KeyImageGroup group{derivedName(document), true, {}, 0};
  const QString text = shownText(document.text);
  if (!text.isEmpty()) group.name += QStringLiteral(" (%1)").arg(text);
  for (const ReferencedPicture& picture : document.pictures) {
    if (const std::optional<PicturePlace> place = findPicture(open, picture))
      group.pictures.push_back({std::make_shared<const Series>(*place->series), place->index, {}});
    else
      ++group.notHere;
  }
  return group;
}

// Returns which of the four views of a series shows this kind of plane.
ViewId viewOfPlane(ViewKind kind) {
  for (const ViewId id : {axialViewId, coronalViewId, sagittalViewId})
    if (usualKind(id) == kind) return id;
  return axialViewId;
}

}  // namespace

std::vector<KeyImageGroup> listKeyImages(const Workspace& workspace,
                                         const std::vector<DerivedObjectPtr>& derived,
                                         const std::vector<const Series*>& open) {
  std::vector<KeyImageGroup> groups;
  if (KeyImageGroup own = markedHere(workspace); !own.pictures.empty()) groups.push_back(std::move(own));
  for (const DerivedObjectPtr& object : derived)
    if (object->kind == DerivedKind::keyObjects) groups.push_back(markedIn(*object, open));
  return groups;
}

QString keyImageName(const ListedKeyImage& image) {
  const QString which = opensAsFrames(*image.series) ? tr("frame %1").arg(image.index + 1)
                                                     : tr("slice %1").arg(image.index + 1);
  return QStringLiteral("%1, %2").arg(seriesText(*image.series), which);
}

PictureStop viewOfKeyImage(Workspace workspace, const ListedKeyImage& image, const LoadedSeriesPtr& shown) {
  workspace.layout = Layout::one;
  workspace.second = {};
  workspace.focus = axialViewId;
  const std::optional<int> slice = drawnSlice(*image.series, image.index);
  if (!shown || opensAsFrames(*image.series) || !slice) {
    workspace = withFrames(std::move(workspace), axialViewId, *image.series);
    FlatLook& look = workspace.editView(axialViewId).flats.editOrAdd(keyOf(*image.series));
    look.frame = image.index;
    look.windowAlone = image.window;
    return {std::move(workspace), axialViewId};
  }
  const VoxelGeometry& geometry = shown->volume->geometry();
  const ViewId id = viewOfPlane(acquiredKind(geometry));
  ViewState& view = workspace.editView(id);
  view.kind = usualKind(id);
  view.series = keyOf(*image.series);
  FlatLook& look = view.flats.editOrAdd(view.series);
  look.slabMm = 0;
  look.windowAlone = image.window;
  glm::dvec3 pVoxel = geometry.voxelFromPatient(geometry.centre());
  pVoxel.z = *slice;
  workspace.crosshairs.editOrAdd(frameOfReference(*image.series)) = {geometry.patientFromVoxel(pVoxel)};
  workspace.focus = id;
  return {std::move(workspace), id};
}

}  // namespace volumen
