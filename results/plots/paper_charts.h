#pragma once

#include <QImage>

#include "results/plots/chart.h"
#include "viewer/paper/paper.h"

namespace volumen {

/// Returns figure 9: speed-up by threads, one line a volume, and the ideal of N threads.
Chart speedUpByThreads(const PaperBench& bench, const StudyTitle& title);

/// Returns figure 3: the two spheres side by side with their names.
QImage figure3Image(const PaperFigure3& figure);

}  // namespace volumen
