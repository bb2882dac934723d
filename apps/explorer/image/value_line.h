#pragma once

#include <QString>
#include <QWidget>
#include <vector>

namespace emca::explorer {

class Theme;

/// Values of a pixel below the picture: a row for the image and one for the reference, their numbers in columns. Painted
/// by itself, since labels that change with every move of the mouse would lay out the window anew.
class ValueLine : public QWidget {
    Q_OBJECT
  public:
    enum class Ink { muted, red, green, blue, plain };
    struct Value {
        QString label, number;
        Ink ink = Ink::muted;            ///< of the label; the number is text, or warning where it should not be
        bool warns = false;
        friend bool operator==(const Value&, const Value&) = default;
    };
    struct Row {
        QString name;
        bool muted = false;              ///< the name
        std::vector<Value> values;       ///< in columns from the left
        std::vector<Value> remarks;      ///< from the right; left out where there is no room
        friend bool operator==(const Row&, const Row&) = default;
    };

    explicit ValueLine(Theme& theme, QWidget* parent = nullptr);
    void setRows(const std::vector<Row>& rows);
    const std::vector<Row>& rows() const { return rows_; }
    /// How many rows there is room for, also while they are empty: nothing jumps.
    void setRowCount(int rows);

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    void paintRow(QPainter& painter, const Row& row, const QRect& box) const;
    int paintValue(QPainter& painter, const Value& value, int x, const QRect& box) const;
    int widthOf(const Value& value, const QFontMetrics& metrics) const;
    Theme& theme_;
    std::vector<Row> rows_;
};

}  // namespace emca::explorer
