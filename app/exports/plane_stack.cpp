#include "app/exports/plane_stack.h"

namespace volumen {

Result<SliceStack> planeStack(const ExportJob& job, const AskedPlane& asked, const VoxelGeometry& geometry) {
  const auto plane = makePlane(job.plane, asked, geometry);
  if (!plane) return plane.error();
  const double distanceMm = job.spacingMm          ? *job.spacingMm
                            : job.plane.slabMm > 0 ? job.plane.slabMm
                                                   : wheelStep(geometry, plane->normal());
  if (job.plane.at || job.plane.index || asked.centre) return SliceStack{*plane, 1, distanceMm};
  return stackThrough(geometry, *plane, distanceMm);
}

}  // namespace volumen
