#pragma once

#include <Qt>

namespace volumen {

/// What an item of the list of studies knows: the key of a patient or study, the path that was opened, the
/// number of its series there (of steps of one series: of the one that a click shows), or of its object that
/// refers to pictures.
enum StudyItemRole { keyRole = Qt::UserRole, pathRole, stepRole, derivedRole };

}  // namespace volumen
