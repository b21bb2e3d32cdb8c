// SPDX-License-Identifier: MIT
// synthetic_report FOLDER: a report of made-up results, for the test that opens it in a browser.
#include "ChartReport.h"
#include "ResultsFile.h"

#include <support/SyntheticChart.h>

#include <exception>
#include <iostream>

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    try {
        const gnomon::examples::ChartResults results = test::syntheticChart();
        test::writePictures(results, argv[1]);
        gnomon::examples::saveResults(results, argv[1]);
        gnomon::examples::writeReport(results, argv[1]);
    } catch (const std::exception& error) {
        std::cerr << error.what() << std::endl;
        return 1;
    }
    return 0;
}
