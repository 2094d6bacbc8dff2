#include "viewer/plan/levels.h"

#include "viewer/plan/rule_lines.h"

namespace volumen {

std::string promiseText(Quality quality) {
  if (quality == Quality::draft) {
    const std::string edge = std::to_string(draftPromise.blockEdge);
    return "means over " + edge + " x " + edge + " pixels within " + inDigits(draftPromise.mostRmse) +
           "/255 RMSE of standard, the mean colour within " + inDigits(draftPromise.mostMeanColour) + "/255";
  }
  const LevelPromise& p = promiseOf(quality);
  if (quality == Quality::exact) return "maximum <= " + inDigits(p.mostMaximum) + "/255";
  return "PSNR >= " + inDigits(p.leastPsnrDb) + " dB, 99th percentile <= " + inDigits(p.most99) + "/255";
}

}  // namespace volumen
