// SPDX-License-Identifier: MIT
#include "FigureSvg.h"

#include <regex>

namespace gnomon::examples {
namespace {

std::string replaced(std::string text, const std::string& old, const std::string& by) {
    for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += by.size())
        text.replace(at, old.size(), by);
    return text;
}

std::string entityOf(char c) {
    switch (c) {
    case '&':
        return "&amp;";
    case '<':
        return "&lt;";
    case '>':
        return "&gt;";
    case '"':
        return "&quot;";
    case '\'':
        return "&#39;";
    default:
        return static_cast<unsigned char>(c) < 32 ? " " : std::string(1, c);
    }
}

/// What a marker's group begins with.
std::string groupOf(const FigureMarker& marker) {
    return "<g class=\"point\" data-kit=\"" + escaped(marker.kit) + "\" data-technique=\"" + escaped(marker.technique) +
           "\" data-setting=\"" + escaped(marker.setting) + "\"><title>" + escaped(marker.text) + "</title>";
}

/// gnuplot writes a marker's text into a script, which would do nothing here; the text is the marker's number.
std::string withMarkers(const std::string& svg, const std::vector<FigureMarker>& markers) {
    static const std::regex group("<g onmousemove=\"gnuplot_svg\\.showHypertext\\(evt,'(\\d+)'\\)\" "
                                  "onmouseout=\"gnuplot_svg\\.hideHypertext\\(\\)\"><title> </title>");
    std::string result;
    auto at = svg.cbegin();
    for (std::sregex_iterator found(svg.begin(), svg.end(), group), end; found != end; ++found) {
        result.append(at, (*found)[0].first);
        result += groupOf(markers.at(std::stoul((*found)[1])));
        at = (*found)[0].second;
    }
    return result.append(at, svg.cend());
}

} // namespace

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) result += entityOf(c);
    return result;
}

std::string figureSvg(const std::string& svg, const std::string& name, const std::vector<FigureMarker>& markers) {
    std::string text = replaced(svg, "id='gp", "id='" + name + "-gp");
    text = replaced(text, "xlink:href='#gp", "xlink:href='#" + name + "-gp");
    text = replaced(text, "id=\"gnuplot_", "id=\"" + name + "-gnuplot_");
    const std::string family = "font-family=\"DejaVu Sans, Verdana, Arial, sans-serif\"";
    text = replaced(text, "font-family=\"DejaVu Sans\"", family);
    text = replaced(text, "font-family=\"DejaVu Sans:Bold\"", family + " font-weight=\"bold\"");
    return withMarkers(text, markers);
}

} // namespace gnomon::examples
