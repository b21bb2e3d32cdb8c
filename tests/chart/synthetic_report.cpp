// SPDX-License-Identifier: MIT
// synthetic_report FOLDER: a report and a stability table of made-up results, for the test that opens it in a browser.
#include "ChartReport.h"
#include "ResultsFile.h"
#include "StabilityPage.h"
#include "StabilityResults.h"

#include <support/SyntheticChart.h>

#include <exception>
#include <iostream>

namespace {

using namespace gnomon::examples;

/// One that holds, and two that leave their budget by 5 and 2 pixels.
StabilityResults syntheticStability() {
    StabilityResults results;
    results.scenes = {{"T1", "tests", "Box", "About.", "radius", "m", {1.0}}};
    for (const double p95 : {0.5, 5.0, 2.0}) {
        StabilityCell cell;
        cell.measured = true;
        cell.everywhere.p95 = p95;
        cell.everywhere.shadow = 100;
        StabilityRow row;
        row.scene = "T1";
        row.kit = "Gnomon";
        row.technique = "map";
        row.setting = "defaults";
        row.cells = {cell};
        results.rows.push_back(row);
    }
    return results;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    try {
        const ChartResults results = test::syntheticChart();
        test::writePictures(results, argv[1]);
        saveResults(results, argv[1]);
        writeReport(results, argv[1]);
        writeStabilityPage(syntheticStability(), argv[1]);
    } catch (const std::exception& error) {
        std::cerr << error.what() << std::endl;
        return 1;
    }
    return 0;
}
