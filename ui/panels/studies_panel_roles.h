#pragma once

#include <Qt>

namespace volumen {

/// Data of an item of the list of studies: the key of a patient or study, the opened path, and the number in
/// it of a series (the time point that a click shows) or of a derived object.
enum StudyItemRole { keyRole = Qt::UserRole, pathRole, stepRole, derivedRole };

}  // namespace volumen
