#pragma once

#include <QImage>

#include "ui/plots/chart.h"
#include "viewer/paper/paper.h"

namespace volumen {

/// Figure 9: speed-up by threads, a line a volume, and what N threads could give at most.
Chart speedUpByThreads(const PaperBench& bench, const StudyTitle& title);

/// Figure 3: the two spheres side by side, named.
QImage figure3Image(const PaperFigure3& figure);

}  // namespace volumen
