#pragma once

#include <string>
#include <vector>

#include "io/report.h"

namespace volumen {

/// Returns a unit of UCUM.
Code ucum(const char* value, const char* meaning);

// Codes of measurements (PS3.16 CID 7470 and others). OHIF compares their meanings to the letter.
inline const Code lengthCode{"410668003", "SCT", "Length"}, angleCode{"1483009", "SCT", "Angle"},
    areaCode{"42798000", "SCT", "Area"}, volumeCode{"118565006", "SCT", "Volume"},
    longAxisCode{"103339001", "SCT", "Long Axis"}, shortAxisCode{"103340004", "SCT", "Short Axis"},
    ratioCode{"cardiothoracic", "99VOLUMEN", "Cardiothoracic ratio"}, meanCode{"373098007", "SCT", "Mean"},
    deviationCode{"386136009", "SCT", "Standard Deviation"}, leastCode{"255605001", "SCT", "Minimum"},
    mostCode{"56851009", "SCT", "Maximum"}, peakCode{"126031", "DCM", "Peak Value Within ROI"};

inline const Code millimetre = ucum("mm", "millimeter"), squareMillimetre = ucum("mm2", "square millimeter"),
                  millilitre = ucum("ml", "milliliter"), degree = ucum("deg", "degree"),
                  ratio = ucum("{ratio}", "ratio");

/// Returns the UCUM unit of values (CID 7181).
Code unitOfValues(const std::string& unit);

/// Returns mean, standard deviation, minimum and maximum as measurements.
std::vector<ReportMeasurement> reportedValues(double mean, double sd, double min, double max,
                                              const Code& unit);

}  // namespace volumen
