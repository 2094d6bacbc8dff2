#include "ui/workspace/layout_text.h"

#include "results/text/text.h"

namespace volumen {

QString gridText(const Layout& grid) {
  const QString rows = grid.rows == 1 ? tr("1 row") : tr("%1 rows").arg(grid.rows);
  const QString columns = grid.columns == 1 ? tr("1 column") : tr("%1 columns").arg(grid.columns);
  return tr("%1, %2").arg(rows, columns);
}

QString invitationText(const ViewState& view) {
  const QString how = tr("Drop a series here, or click here and choose one in the list of studies.");
  return view.wanted.empty() ? how : shownText(view.wanted) + QLatin1Char('\n') + how;
}

}  // namespace volumen
