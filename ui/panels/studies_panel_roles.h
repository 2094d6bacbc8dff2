#pragma once

#include <Qt>

namespace volumen {

/// Data of an item of the list of studies: the key of a patient or study, the opened path, and the number of
/// a series or derived object in it. A row of several time points holds the series that a click shows.
enum StudyItemRole { keyRole = Qt::UserRole, pathRole, stepRole, derivedRole };

}  // namespace volumen
