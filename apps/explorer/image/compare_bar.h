#pragma once

#include <QWidget>

class QButtonGroup;
class QComboBox;

namespace emca::explorer {

class ImageModel;
class TextLine;
class Theme;

/// The row below the header while there is a reference: image, reference, both, or their difference by a metric and its
/// mean. Says so when the two cannot be compared.
class CompareBar : public QWidget {
    Q_OBJECT
  public:
    CompareBar(ImageModel& model, Theme& theme, QWidget* parent = nullptr);

  private:
    void refresh();
    QString resultText() const;
    ImageModel& model_;
    QButtonGroup* modes_;
    QComboBox* metric_;
    TextLine* result_;
};

}  // namespace emca::explorer
