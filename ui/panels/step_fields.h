#pragma once

#include <QComboBox>
#include <QGridLayout>
#include <map>
#include <string>

#include "ui/controller/offered_steps.h"

namespace volumen {

/// The fields of a kind of step, with names and units. Typed numbers are kept for all kinds with a field of
/// that name. Voxel values are kept for the series only.
class StepFields : public QWidget {
  Q_OBJECT
 public:
  explicit StepFields(Session& session, QWidget* parent = nullptr);

  /// Shows the fields of another kind with the present segments.
  void showKind(const StepKind& kind);
  /// Returns the values for a kind: as typed, else its defaults.
  std::map<std::string, StepValue> valuesFor(const StepKind& kind) const;
  /// Returns a sentence why the kind cannot run with these values, empty if it can.
  QString whyNot(const StepKind& kind) const;

 Q_SIGNALS:
  void changed();

 private:
  QWidget* fieldFor(const StepField& field);
  QWidget* numberFor(const StepField& field);
  QComboBox* wordsFor(const StepField& field);
  QComboBox* segmentsFor(const StepField& field);
  StepValue valueOf(const StepField& field) const;
  std::string segmentOf(const StepField& field) const;
  void take(const StepField& field, const StepValue& value);
  void forgetOtherSeries();
  QStringList shownBy(const StepKind& kind) const;

  Session& session_;
  QGridLayout* grid_;
  std::map<std::string, StepValue> typed_;   // by field name, except values_
  std::map<std::string, StepValue> values_;  // voxel values, stored and not as shown
  LoadedSeriesPtr series_;
  QStringList shown_;
};

}  // namespace volumen
