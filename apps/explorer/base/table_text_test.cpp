#include "base/table_text.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QClipboard>
#include <QHeaderView>
#include <QListView>
#include <QStandardItemModel>
#include <QTableView>
#include <QTest>
#include <QTreeView>

namespace emca::explorer {
namespace {

class SmallTable : public ::testing::Test {
  protected:
    SmallTable() : model(3, 3) {
        model.setHorizontalHeaderLabels({"Path", "Value, W/(sr m²)", "σ"});
        const char* cells[3][3] = {{"a", "1.235", "2"}, {"b, \"c\"", "0.1000", "3"}, {"d\te", "NaN", "4"}};
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column) model.setItem(row, column, new QStandardItem(cells[row][column]));
        model.item(0, 1)->setData("1.23456", kCopyRole);
        view.setModel(&model);
        view.setSelectionBehavior(QAbstractItemView::SelectRows);
        enableTableCopy(view);
        view.resize(400, 200);
        view.show();
    }
    QString copied() { return QApplication::clipboard()->text(); }
    QStandardItemModel model;
    QTableView view;
};

TEST_F(SmallTable, CtrlCCopiesTheSelectedRowsInFull) {
    QTest::mouseClick(view.viewport(), Qt::LeftButton, {}, view.visualRect(model.index(0, 0)).center());
    QTest::mouseClick(view.viewport(), Qt::LeftButton, Qt::ControlModifier, view.visualRect(model.index(2, 0)).center());
    QTest::keyClick(&view, Qt::Key_C, Qt::ControlModifier);
    EXPECT_EQ(copied(), "Path\tValue, W/(sr m²)\tσ\na\t1.23456\t2\nd e\tNaN\t4\n");
    QTest::keyClick(&view, Qt::Key_C, Qt::ControlModifier | Qt::ShiftModifier);
    EXPECT_EQ(copied().count('\n'), 4) << "all rows and the names";
}

TEST_F(SmallTable, WithoutSelectionAllRowsAreMeant) {
    EXPECT_EQ(tableText(view, TableFormat::tabs, true), tableText(view, TableFormat::tabs, false));
}

TEST_F(SmallTable, CsvQuotesWhatItHasTo) {
    const QString csv = tableText(view, TableFormat::csv, false);
    EXPECT_EQ(csv.section('\n', 0, 0), "Path,\"Value, W/(sr m²)\",σ");
    EXPECT_EQ(csv.section('\n', 2, 2), "\"b, \"\"c\"\"\",0.1000,3");
    // And back again, for the clipboard.
    EXPECT_EQ(tabsFromCsv(csv).section('\n', 2, 2), "b, \"c\"\t0.1000\t3");
}

TEST_F(SmallTable, ColumnsAreThoseOnScreenInTheirOrder) {
    view.setColumnHidden(1, true);
    view.horizontalHeader()->moveSection(2, 0);
    EXPECT_EQ(tableText(view, TableFormat::tabs, false).section('\n', 0, 1), "σ\tPath\n2\ta");
}

TEST(TableText, ATreeCopiesWhatIsOpen) {
    QStandardItemModel model;
    model.setHorizontalHeaderLabels({"Item", "Value"});
    auto* path = new QStandardItem("path 1");
    model.appendRow({path, new QStandardItem("0.5")});
    model.appendRow({new QStandardItem("path 2"), new QStandardItem("0.7")});
    path->appendRow({new QStandardItem("vertex 1"), new QStandardItem("glass")});
    QTreeView tree;
    tree.setModel(&model);
    EXPECT_EQ(tableText(tree, TableFormat::tabs, false), "Item\tValue\npath 1\t0.5\npath 2\t0.7\n");
    tree.expandAll();
    EXPECT_EQ(tableText(tree, TableFormat::tabs, false), "Item\tValue\npath 1\t0.5\n  vertex 1\tglass\npath 2\t0.7\n");
}

/// An entry of a list that says many things.
class Entries : public QStandardItemModel {
  public:
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override {
        return role == kCopyRole ? QVariant(QStringList{"pixel", "paths"}) : QStandardItemModel::headerData(section, orientation, role);
    }
};

TEST(TableText, AnEntryMayBeSeveralCells) {
    Entries model;
    auto* entry = new QStandardItem("(1, 2)");
    entry->setData(QStringList{"(1, 2)", "64"}, kCopyRole);
    model.appendRow(entry);
    QListView list;
    list.setModel(&model);
    EXPECT_EQ(tableText(list, TableFormat::tabs, false), "pixel\tpaths\n(1, 2)\t64\n");
}

TEST(TableText, AListHasNoLineOfNames) {
    QStandardItemModel model;
    model.appendRow(new QStandardItem("(1, 2)"));
    QListView list;
    list.setModel(&model);
    EXPECT_EQ(tableText(list, TableFormat::tabs, false), "(1, 2)\n");
    EXPECT_EQ(tableText(QListView(), TableFormat::tabs, false), "") << "no model, no rows";
}

}  // namespace
}  // namespace emca::explorer
