#pragma once

#include "ui/exports/picture_maker.h"
#include "ui/exports/study_numbers.h"

namespace volumen {

/// Makes the pictures of a report and, after those of each study, the tables of its numbers. `pictures` are
/// in the order of the studies. Numbers that are not there yet are computed on other threads.
PictureMakerPtr reportPages(const PictureMakerPtr& pictures, const std::vector<ReportedStudy>& studies,
                            const Session& session, bool namesHidden);

}  // namespace volumen
