#pragma once

#include <QSpinBox>

namespace emca::explorer {

/// Samples per pixel: steps double and halve.
class SampleBox : public QSpinBox {
    Q_OBJECT
  public:
    explicit SampleBox(QWidget* parent = nullptr) : QSpinBox(parent) {
        setRange(1, 1 << 20);
        setValue(64);
        setSuffix(tr(" spp"));
        setAlignment(Qt::AlignRight);
        setToolTip(tr("Samples per pixel of the next render"));
    }
    void stepBy(int steps) override {
        for (; steps > 0; --steps) setValue(value() > maximum() / 2 ? maximum() : value() * 2);
        for (; steps < 0; ++steps) setValue(value() / 2);
    }
};

}  // namespace emca::explorer
