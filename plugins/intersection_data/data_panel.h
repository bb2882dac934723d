#pragma once

#include <QWidget>
#include <optional>
#include <vector>

#include "emca/explorer/plugin_context.h"
#include "quantities.h"

class QLabel;
class QScrollArea;
class QSplitter;
class QToolButton;
class QTreeWidget;
class QVBoxLayout;

namespace emca::intersection_data {

/// The list of quantities of the selected path, with their values at the selected vertex, and a plot of each chosen one
/// over depth. Points are linked: hovering and clicking one is hovering and selecting its vertex in every view.
class DataPanel : public QWidget {
    Q_OBJECT
  public:
    explicit DataPanel(explorer::PluginContext& context);

  protected:
    void showEvent(QShowEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

  private:
    /// A plot in the column, and the vertices that its points stand for.
    struct Shown {
        explorer::Plot* plot = nullptr;
        std::size_t quantity = 0;
        bool overDepth = true;
        std::vector<std::vector<Index>> vertices;   ///< of each series, of each point
    };

    void makeControls();
    void restyle();
    void reload();                 ///< another path, or other data
    void fillList();
    void choose();                 ///< the chosen rows became others
    void plotChosen();
    explorer::Plot& plotAt(std::size_t row);
    void connectPlot(std::size_t row);
    void fillPlot(Shown& shown, const Quantity& quantity);
    std::vector<explorer::PlotSeries> seriesOf(Shown& shown, const Quantity& quantity) const;
    QString describe(const Shown& shown, explorer::PlotPoint point) const;
    void placePlots();
    void showVertex();
    void showHovered();
    void setLog(bool log);
    void keepSettings();
    std::vector<explorer::PlotPoint> pointsOf(const Shown& shown, std::optional<Index> vertex) const;
    std::optional<Index> currentPath() const;
    std::optional<Index> vertexAt(const std::optional<client::VertexId>& id) const;
    client::VertexId idOf(Index vertex) const;
    QIcon swatch(const Quantity& quantity, Index vertex) const;

    explorer::PluginContext& context_;
    std::optional<Index> path_;
    std::vector<Quantity> quantities_;
    QStringList chosen_;           ///< names; kept from path to path, and for the next start
    std::vector<Shown> shown_;
    std::vector<explorer::Plot*> plots_;   ///< made once and used again; more of them than shown_, maybe
    bool filling_ = false, stale_ = true, log_ = false;
    QSplitter* splitter_ = nullptr;
    QTreeWidget* list_ = nullptr;
    QScrollArea* scroll_ = nullptr;
    QWidget* column_ = nullptr;
    QVBoxLayout* rows_ = nullptr;
    QLabel* title_ = nullptr;
    QToolButton* logButton_ = nullptr;
    explorer::Subscription dataset_, selection_, look_, settings_;
};

}  // namespace emca::intersection_data
