#include "cli/report_page.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "cli/closing_table.h"
#include "cli/format.h"
#include "cli/html.h"

namespace radfarm::cli {
namespace {

using nlohmann::json;

/// What a reader sees of a value: four digits, a dash for nothing.
std::string shown(const json& value) {
  if (value.is_string()) return escaped(value.get<std::string>());
  if (value.is_number_float()) return format("%.4g", value.get<double>());
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  return value.is_null() ? "–" : escaped(value.dump());
}

std::string percent(const json& share) { return share.is_number() ? format("%.3g %%", 100 * share.get<double>()) : "–"; }

double number(const json& object, const char* key) {
  return object.is_object() && object.contains(key) && object[key].is_number() ? object[key].get<double>() : 0;
}

json part(const json& report, const char* pointer) {
  const json::json_pointer at(pointer);
  return report.contains(at) ? report[at] : json();
}

std::string bar(double share) {
  return format("<div style=\"background:#0072b2;height:.8em;width:%.1fem\"></div>", 14 * std::clamp(share, 0.0, 1.0));
}

std::string time_section(const json& report) {
  const json stages = part(report, "/stages");
  if (!stages.is_array()) return "";
  double all = 0;
  for (const json& stage : stages) all += number(stage, "cpu_s");
  std::vector<std::vector<std::string>> rows;
  for (const json& stage : stages) {
    const double cpu = number(stage, "cpu_s");
    rows.push_back({shown(stage.value("name", json())), format("%.2f", number(stage, "wall_s")), format("%.2f", cpu),
                    bar(all > 0 ? cpu / all : 0)});
  }
  rows.push_back({"all", "", format("%.2f", all), ""});
  return "<h2>Where the time went</h2>\n" + html_table({"stage", "wall s", "CPU s", ""}, rows);
}

std::string effects_section(const json& report) {
  const json effects = part(report, "/effects");
  if (!effects.is_array()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const json& e : effects) {
    if (!e.is_object()) continue;
    rows.push_back({shown(e.value("id", json())), e.value("active", false) ? "on" : "off", shown(e.value("value", json())),
                    shown(e.value("bound", json())), shown(e.value("bound_kind", json())), shown(e.value("test", json())),
                    shown(e.value("note", json()))});
  }
  return "<h2>Effects</h2>\n<p class=\"note\">What is off can change reflected light by at most its bound, cd/m².</p>\n" +
         html_table({"effect", "", "value", "bound", "kind", "on where", ""}, rows);
}

std::string rounds_section(const json& report) {
  const json rounds = part(report, "/rounds");
  if (!rounds.is_array() || rounds.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const json& round : rounds) {
    if (!round.is_object()) continue;
    const json ci = round.value("relative_rmse_ci95", round.value("ci95", json()));
    const bool is_interval = ci.is_array() && ci.size() == 2 && ci[0].is_number() && ci[1].is_number();
    rows.push_back({std::to_string(rows.size() + 1), shown(round.value("kind", json())), percent(round.value("relative_rmse", json())),
                    is_interval ? percent(ci[0]) + " to " + percent(ci[1]) : "–", shown(round.value("cpu_s", json()))});
  }
  return "<h2>Rounds</h2>\n" + html_table({"round", "what", "relative error", "95 %", "CPU s"}, rows);
}

/// The audit's lattice as blocks of the image: how much of the squared error lies in each.
std::string map_section(const json& report) {
  const json map = part(report, "/accuracy/map");
  if (!map.is_object() || !map.value("share", json()).is_array()) return "";
  const auto columns = std::max<std::size_t>(1, map.value("columns", std::size_t{1}));
  double most = 0;
  for (const json& share : map["share"]) most = std::max(most, share.is_number() ? share.get<double>() : 0.0);
  std::string text = "<h2>Where the error is</h2>\n<p class=\"note\">Share of the mean squared error by part of the image, as the audit "
                     "measured it; parts near 0 may be below 0 within the audit's noise.</p>\n<table>";
  std::size_t i = 0;
  for (const json& share : map["share"]) {
    if (i % columns == 0) text += i == 0 ? "<tr>" : "</tr>\n<tr>";
    const double value = share.is_number() ? share.get<double>() : 0;
    const double strength = most > 0 ? std::clamp(value / most, 0.0, 1.0) : 0;
    text += format("<td style=\"background:rgba(213,94,0,%.2f)\">%.1f %%</td>", strength, 100 * value);
    ++i;
  }
  return text + "</tr></table>\n";
}

std::string next_section(const json& report) {
  const json next = part(report, "/next_halving");
  if (!next.is_object() || !(number(next, "cpu_s") > 0)) return "";
  return "<h2>What the next step costs</h2>\n<p>Half the error: about " + shown(next["cpu_s"]) + " CPU s" +
         (number(next, "wall_s") > 0 ? ", " + shown(next["wall_s"]) + " s on this farm" : std::string()) +
         (next.contains("from") ? " (" + shown(next["from"]) + ")" : std::string()) + ".</p>\n";
}

std::string list_section(const json& report) {
  std::string text;
  for (const auto& [pointer, title] : {std::pair{"/warnings", "Warnings"}, std::pair{"/accuracy/unaudited", "Not audited"}}) {
    const json lines = part(report, pointer);
    if (!lines.is_array() || lines.empty()) continue;
    text += std::string("<h2>") + title + "</h2>\n<ul>";
    for (const json& line : lines) text += "<li>" + shown(line) + "</li>";
    text += "</ul>\n";
  }
  return text;
}

std::string table_of(const std::string& title, const json& object) {
  if (!object.is_object() || object.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, value] : object.items()) {
    if (value.is_object()) {
      for (const auto& [inner, inner_value] : value.items()) rows.push_back({escaped(name + "." + inner), shown(inner_value)});
    } else {
      rows.push_back({escaped(name), shown(value)});
    }
  }
  return "<h2>" + title + "</h2>\n" + html_table({"", ""}, rows);
}

}  // namespace

std::string report_page(const json& report, std::span<const std::byte> png) {
  const std::string path = part(report, "/image/path").is_string() ? part(report, "/image/path").get<std::string>() : "image";
  std::string body = "<h1>" + escaped(path) + "</h1>\n<p class=\"big\">" + escaped(accuracy_line(report)) + "</p>\n";
  if (!png.empty()) body += "<p>" + png_image(png, path) + "</p>\n";
  body += map_section(report) + next_section(report) + rounds_section(report) + time_section(report) + effects_section(report) +
          list_section(report) + table_of("Counts", part(report, "/counts")) + table_of("Energy, lm", part(report, "/energy")) +
          table_of("Settings", part(report, "/settings/resolved"));
  body += "<p class=\"note\">scene " + shown(part(report, "/scene/digest")) + "<br>image " + shown(part(report, "/image/digest")) + "</p>\n";
  return html_page(path, body);
}

}  // namespace radfarm::cli
