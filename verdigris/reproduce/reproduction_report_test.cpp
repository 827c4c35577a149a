// SPDX-License-Identifier: MIT
// The page with everything missing, and with results that are not what they should be: it is
// written all the same and says what is not there.
#include "verdigris/reproduce/reproduction_report.h"

#include <gtest/gtest.h>

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/testing.h"
#include "verdigris/report/table_formats.h"

namespace verdigris {
namespace {

const Table& table_of(const Report& report, const std::string& id) {
    for (const ReportSection& s : report.sections)
        for (const ReportBlock& b : s.blocks)
            if (const auto* t = std::get_if<Table>(&b); t && t->id == id) return *t;
    throw std::runtime_error("no table " + id);
}

class ReproductionReport : public ::testing::Test {
  protected:
    Report report() {
        const TaskGraph graph(reproduction_tasks(options_));
        std::vector<TaskOutcome> outcomes(graph.tasks().size());
        for (std::size_t i = 0; i < outcomes.size(); ++i) {
            outcomes[i].state = done_ ? TaskState::done : TaskState::failed;
            if (!done_) outcomes[i].sentence = "no luck today";
        }
        return reproduction_report({options_, folder_.path(), graph, outcomes});
    }
    ScratchFolder folder_;
    ReproductionOptions options_;
    bool done_ = false;
};

TEST_F(ReproductionReport, StandsWithThePapersValuesWhereAllOfOursFailed) {
    const Report r = report();
    EXPECT_NO_THROW(check_report(r));
    const std::string page = page_html(r, {});
    EXPECT_NE(page.find("no luck today"), std::string::npos);
    for (const char* id : {"table1", "table1-horizons", "table2", "table3", "table3-lpips",
                           "figure4-gains", "figure5", "training", "figures12", "intervals"}) {
        const Table& table = table_of(r, id);
        EXPECT_FALSE(table_plain(table).empty()) << id;
        EXPECT_NO_THROW(table_latex(table)) << id;
    }
    const std::string plain = table_plain(table_of(r, "table1"));
    EXPECT_NE(plain.find("-3785.0 %"), std::string::npos) << plain;
    EXPECT_NE(plain.find("n/a"), std::string::npos);
}

TEST_F(ReproductionReport, CountsOnlyAuditsThatWereMade) {
    options_.no_networks = "no libtorch";
    const TaskGraph graph(reproduction_tasks(options_));
    std::vector<TaskOutcome> outcomes(graph.tasks().size());
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        const std::string& missing = graph.tasks()[i].missing;
        outcomes[i].state = missing.empty() ? TaskState::done : TaskState::missing;
        outcomes[i].sentence = missing;
    }
    const std::string page =
        page_html(reproduction_report({options_, folder_.path(), graph, outcomes}), {});
    EXPECT_NE(page.find("1 of 1 audits that were made found nothing"), std::string::npos);
    EXPECT_NE(page.find("4 more were not made"), std::string::npos);
}

TEST_F(ReproductionReport, SaysWhichFileIsDamaged) {
    done_ = true;
    write_file(folder_ / "evaluate/evaluation.json", "{\"directions\": 3}");
    write_file(folder_ / "drift/drift.json", "not json");
    const std::string page = page_html(report(), {});
    EXPECT_NE(page.find("evaluation.json: is not what this version writes"), std::string::npos);
    EXPECT_NE(page.find("drift.json: is not what this version writes"), std::string::npos);
}

TEST_F(ReproductionReport, QuickIsSaidOnEveryTableThatItTouches) {
    options_.quick = true;
    const Report r = report();
    EXPECT_EQ(r.subtitle, "quick: not the paper's settings");
    for (const char* id :
         {"table1", "table1-horizons", "table2", "table3", "table3-lpips", "figure4-gains",
          "figure4-movement", "figure5", "training", "figures12", "intervals"})
        EXPECT_NE(table_of(r, id).caption.find("not the paper's settings"), std::string::npos)
            << id;
}

TEST_F(ReproductionReport, PutsOursInThePapersPlaces) {
    done_ = true;
    const auto forecaster = [](double mean, double gain) {
        return "{\"error\": {\"mean\": " + std::to_string(mean) +
               ", \"per_horizon\": [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]}, \"delta_e\": 1, \"gain\": " +
               std::to_string(gain) +
               ", \"gain_per_horizon\": [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1], "
               "\"intervals\": {\"block\": null, \"naive\": [0, 1]}, \"blocks\": []}";
    };
    const std::string still =
        "{\"error\": {\"mean\": 3, \"per_horizon\": [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]}}";
    write_file(folder_ / "evaluate/evaluation.json",
               "{\"directions\": [{\"label\": \"air -> chamber\", \"windows\": 4, \"forecasters\": "
               "{\"persistence\": " +
                   still + ", \"affinergb\": " + forecaster(7, 0.25) +
                   "}}, {\"label\": \"chamber -> air\", \"windows\": 4, \"forecasters\": "
                   "{\"persistence\": " +
                   still + ", \"affinergb\": " + forecaster(8, -0.5) + "}}]}");
    const Table table = table_of(report(), "table1");
    ASSERT_EQ(table.groups.size(), 2u);
    // chamber -> air is the paper's first block and our second direction.
    const TableRow& first = table.groups[0].rows[1];
    EXPECT_EQ(first[0].words(), "affinergb");
    EXPECT_EQ(first[1].value(), 1.85e-4);
    EXPECT_EQ(first[2].value(), 8);
    EXPECT_EQ(first[3].value(), 0.134);
    EXPECT_EQ(first[4].value(), -0.5);
    EXPECT_EQ(table.groups[1].rows[1][4].value(), 0.25);
    const Table by_horizon = table_of(report(), "table1-horizons");
    EXPECT_EQ(by_horizon.groups[0].rows[1][1].value(), 3.22e-5);
    EXPECT_EQ(by_horizon.groups[0].rows[1][2].value(), 1);
    EXPECT_EQ(by_horizon.groups[0].rows[1][4].value(), 5);
}

TEST_F(ReproductionReport, ReadsMaterialsAndSaysWhyThereIsNoLpips) {
    done_ = true;
    const std::string row =
        "{\"horizons\": [{\"horizon\": 5, \"flip\": 0.25, \"lpips\": null, \"gain\": "
        "{\"gain\": 0.5, \"interval\": [0.25, 0.75], \"windows\": 5, \"blocks\": ["
        "{\"first_start\": 0, \"last_start\": 0, \"windows\": 1, \"gain\": 0.5}]}}]}";
    const std::string direction =
        "\"windows\": 2, \"forecasters\": {\"persistence\": {\"horizons\": [{\"horizon\": 5, "
        "\"flip\": 0.5}]}, \"affinergb\": " +
        row + "}}";
    write_file(folder_ / "materials/materials.json",
               "{\"control\": \"persistence\", \"lpips_unavailable\": \"no weights were "
               "given\", \"directions\": [{\"label\": \"air -> chamber\", " +
                   direction + ", {\"label\": \"chamber -> air\", " + direction + "]}");
    const Table table = table_of(report(), "table3");
    EXPECT_NE(table.note.find("no weights were given"), std::string::npos) << table.note;
    const TableRow& affine = table.groups[0].rows[0];
    EXPECT_EQ(affine[1].value(), 0.253);
    EXPECT_EQ(affine[2].value(), 0.25);
    EXPECT_EQ(affine[4].kind(), TableCell::Kind::missing) << "no t+10";
    EXPECT_EQ(table_of(report(), "table3-lpips").groups[0].rows[0][1].value(), 0.208);
    EXPECT_EQ(table.groups[0].rows[2][2].value(), 0.5) << "the static control";
    // Recording 1 is held out second: its frames are Figure 1.
    write_file(folder_ / "materials/renders/frames-2.png", "\x89PNG");
    const std::string page = page_html(report(), {});
    EXPECT_NE(page.find("<h3>Figure 1: forecast and true frames"), std::string::npos);
    EXPECT_NE(page.find("src=\"data:image/png;base64,iVBORw==\""), std::string::npos);
    EXPECT_NE(page.find("Figure 2: forecast and true frames, air -&gt; chamber: n/a, "),
              std::string::npos);
    // A version of the command that writes something else is told, not guessed at.
    write_file(folder_ / "materials/materials.json", "{\"directions\": []}");
    EXPECT_NE(page_html(report(), {}).find("materials.json: has 0 of the 2 directions"),
              std::string::npos);
    write_file(folder_ / "materials/materials.json", "{\"directions\": [7, 8]}");
    EXPECT_NE(page_html(report(), {}).find("materials.json: is not what this version writes"),
              std::string::npos);
}

TEST_F(ReproductionReport, OneDirectionOfACharacterizationIsNotTakenForBoth) {
    done_ = true;
    write_file(folder_ / "characterize/characterization.json",
               R"({"directions": ["air -> chamber"], "rows": [{"axis": "context", "setting": )"
               R"("n = 3", "context": 3, "directions": {"air -> chamber": {"error": 1, )"
               R"("persistence": 2, "gain": 0.5, "interval": null, "blocks": []}}}], )"
               R"("long_horizons": {"air -> chamber": {"moved": [1], "outside": [1], )"
               R"("persistence": [1], "unclamped": [1]}}})");
    const Report r = report();
    EXPECT_NE(page_html(r, {}).find("characterization.json: has 1 of the 2 directions"),
              std::string::npos);
    EXPECT_EQ(table_of(r, "table2").groups[0].rows[0][2].kind(), TableCell::Kind::missing);
}

TEST_F(ReproductionReport, TellsApartRecordingsOfOneName) {
    options_.recordings = {"/one/plate.mkv", "/two/plate.mp4"};
    EXPECT_EQ(table_of(report(), "figure5").columns[3].header, "ours, learned from plate (2)");
}

TEST_F(ReproductionReport, DrawsTheColorsThatDriftMeasured) {
    done_ = true;
    write_file(folder_ / "drift/drift.json", "{\"recordings\": {}}");
    write_file(folder_ / "drift/tables/drift_series.csv",
               "recording,sample,specimen_red,reference_green,spread_red\n"
               "chamber,0,0.5,0.25,1\nchamber,1,0.75,0.5,1\nair,0,nan,0,0\n");
    const Report r = report();
    const Figure* figure = nullptr;
    for (const ReportSection& s : r.sections)
        for (const ReportBlock& b : s.blocks)
            if (const auto* f = std::get_if<Figure>(&b); f && f->id == "figure4-series") figure = f;
    ASSERT_TRUE(figure);
    ASSERT_EQ(figure->panels.size(), 2u);
    ASSERT_EQ(figure->panels[0].series.size(), 2u);
    EXPECT_EQ(figure->panels[0].series[1].points[1].y, 0.75);
}

}  // namespace
}  // namespace verdigris
