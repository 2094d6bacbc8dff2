#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QToolButton>

#include "ui/controller/segment_editing.h"

namespace volumen {

/// Lets a field show and write an option of segment editing.
void bindOption(QCheckBox* box, SegmentEditing& editing, bool SegmentOptions::*option);
void bindOption(QDoubleSpinBox* field, SegmentEditing& editing, double SegmentOptions::*option);
/// The entries of the list are the enumerators in their order.
template <class Enum>
void bindOption(QComboBox* list, SegmentEditing& editing, Enum SegmentOptions::*option) {
  QObject::connect(list, &QComboBox::currentIndexChanged, list, [&editing, option](int n) {
    editing.choose([&](SegmentOptions& options) { options.*option = Enum(n); });
  });
  const auto show = [list, &editing, option] { list->setCurrentIndex(int(editing.options().*option)); };
  QObject::connect(&editing, &SegmentEditing::optionsChanged, list, show);
  show();
}

/// Makes a button for an action of the window (actionOf()), which the Segments panel connects.
QToolButton* toolButton(const char* name, const char* action);
/// Returns the name of the action that a button of toolButton() is for; empty for other buttons.
QString actionOf(const QToolButton* button);

/// Makes a list that is as narrow as possible, so that the panel stays narrow with long names.
QComboBox* narrowChoice(const char* name, const QString& label);

/// Makes a field for the leak guard of connected components (PartWanted::leakGuardMm), mm; 0 is off. The
/// range is that of the recipe step "connected".
QDoubleSpinBox* leakGuardField();

/// Makes a list of neighbourhoods of connected components (PartWanted::neighbours), in the words of that
/// recipe step.
QComboBox* partNeighboursField();

}  // namespace volumen
