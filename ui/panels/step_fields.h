#pragma once

#include <QComboBox>
#include <QGridLayout>
#include <map>
#include <string>

#include "ui/controller/offered_steps.h"

namespace volumen {

/// The fields of a kind of step, by name and unit. A number that was typed stays for all kinds that have a
/// field of that name; values stay for the series.
class StepFields : public QWidget {
  Q_OBJECT
 public:
  explicit StepFields(Session& session, QWidget* parent = nullptr);

  /// Shows the fields of another kind, with the segments that there are now.
  void showKind(const StepKind& kind);
  /// What is to be taken for a kind: what was typed, else as its row says.
  std::map<std::string, StepValue> valuesFor(const StepKind& kind) const;
  /// Why that kind cannot be done with these, a sentence; empty: it can.
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
  std::map<std::string, StepValue> typed_;   // by name of field, but for
  std::map<std::string, StepValue> values_;  // values of the series, not as shown
  LoadedSeriesPtr series_;
  QStringList shown_;
};

}  // namespace volumen
