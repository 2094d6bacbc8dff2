#pragma once

#include <string>

namespace volumen {

/// Returns a date as ISO 8601 writes it, "2026-03-14", if it is one of DICOM ("20260314") or ACR-NEMA
/// ("2026.03.14"). Returns any other text unchanged.
std::string isoDate(const std::string& date);

}  // namespace volumen
