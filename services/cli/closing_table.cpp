#include "cli/closing_table.h"

#include "cli/format.h"

namespace radfarm::cli {
namespace {

using nlohmann::json;

std::string short_text(const json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return format("%.4g", value.get<double>());
  return value.is_null() ? "-" : value.dump();
}

double number(const json& object, const char* key) {
  return object.contains(key) && object[key].is_number() ? object[key].get<double>() : 0;
}

std::string stages_table(const json& stages) {
  std::string text = format("%-24s %10s %10s\n", "stage", "wall s", "CPU s");
  for (const json& stage : stages) {
    if (!stage.is_object()) continue;
    text += format("%-24s %10.2f %10.2f\n", stage.value("name", std::string("?")).c_str(), number(stage, "wall_s"),
                   number(stage, "cpu_s"));
  }
  return text;
}

std::string counts_table(const json& counts) {
  std::string text;
  for (const auto& [name, count] : counts.items()) {
    if (count.is_number() && count.get<double>() == 0) continue;
    text += format("%-36s %12s\n", name.c_str(), short_text(count).c_str());
  }
  return text;
}

std::string light_groups_table(const json& groups) {
  std::string text = format("%-36s %12s %12s\n", "light group", "lm", "of the image");
  for (const json& group : groups) {
    if (!group.is_object()) continue;
    const std::string name = "light." + group.value("name", std::string("?"));
    text += format("%-36s %12.4g %10.1f %%\n", name.c_str(), number(group, "power_lm"), 100 * number(group, "share_of_image"));
  }
  return text;
}

/// The ids that are on, and those that are off, in two lines.
std::string effects_lines(const json& effects) {
  std::string on;
  std::string off;
  for (const json& effect : effects) {
    if (!effect.is_object()) continue;
    std::string& list = effect.value("active", false) ? on : off;
    list.append(" ").append(effect.value("id", std::string("?")));
  }
  return "effects on: " + (on.empty() ? std::string(" none") : on) +
         "\neffects off:" + (off.empty() ? std::string(" none") : off) + "\n";
}

std::string percent(const json& value) { return format("%.3g %%", 100 * value.get<double>()); }

bool is_interval(const json& value) {
  return value.is_array() && value.size() == 2 && value[0].is_number() && value[1].is_number();
}

std::string round_line(const json& round) {
  const json value = round.value("relative_rmse", json()), interval = round.value("ci95", json());
  std::string error = "not measured";
  if (is_interval(interval)) {
    error = (value.is_number() ? percent(value) : "< " + percent(interval[1])) + " (95 %: " + percent(interval[0]) + " to " +
            percent(interval[1]) + ")";
  }
  return format("%-12s %10.1f %10.2f %10.2f   %s\n", round.value("kind", std::string("?")).c_str(), number(round, "samples"),
                number(round, "cpu_s"), number(round, "wall_s"), error.c_str());
}

}  // namespace

std::string accuracy_line(const json& report) {
  const json accuracy = report.value("accuracy", json::object());
  const double pixels = number(accuracy, "audited_pixels");
  if (pixels <= 0) return "error: not measured (--no-audit)";
  const json value = accuracy.value("relative_rmse", json());
  const json interval = accuracy.value("relative_rmse_ci95", json());
  const std::string audited = format(", %.0f pixels audited", pixels);
  if (value.is_number() && is_interval(interval)) {
    return "relative error " + percent(value) + " (95 %: " + percent(interval[0]) + " to " + percent(interval[1]) +
           ")" + audited;
  }
  if (is_interval(interval)) return "relative error < " + percent(interval[1]) + " (95 %)" + audited;
  return "relative error: undefined, the image is black" + audited;
}

std::string rounds_table(const json& report) {
  std::string text;
  const json accuracy = report.value("accuracy", json::object());
  const json target = accuracy.value("target", json()), met = accuracy.value("target_met", json());
  const json rounds = report.value("rounds", json::array());
  if (target.is_number() || report.contains("time")) {
    text += format("\n%-5s %-12s %10s %10s %10s   %s\n", "round", "", "samples", "CPU s", "wall s", "relative error");
    int number = 0;
    for (const json& round : rounds) {
      if (round.is_object()) text += format("%-5d ", ++number) + round_line(round);
    }
  }
  if (target.is_number()) {
    const char* const verdict = met.is_boolean() ? (met.get<bool>() ? "met" : "NOT met") : "undefined, the image is black";
    text += "target: relative error below " + percent(target) + ": " + verdict + "\n";
  }
  if (report.contains("time") && report["time"].is_object()) {
    text += format("target: %.4g s; it took %.1f s\n", number(report["time"], "target_s"), number(report["time"], "elapsed_s"));
  }
  const json halving = report.value("next_halving", json());
  if (halving.is_object()) {
    text += format("half the error would cost about %.3g CPU s more, %.3g s of wall time (by %s)\n", number(halving, "cpu_s"),
                   number(halving, "wall_s"), short_text(halving.value("from", json())).c_str());
  }
  return text;
}

std::string effects_table(const json& plan) {
  std::string text = format("%-26s %-4s %-12s %-12s %-12s %s\n", "effect", "on", "value", "bound", "kind", "test");
  for (const json& effect : plan.value("effects", json::array())) {
    if (!effect.is_object()) continue;
    text += format("%-26s %-4s %-12s %-12s %-12s %s\n", effect.value("id", std::string("?")).c_str(),
                   effect.value("active", false) ? "on" : "off", short_text(effect.value("value", json())).c_str(),
                   short_text(effect.value("bound", json())).c_str(),
                   short_text(effect.value("bound_kind", json())).c_str(),
                   short_text(effect.value("test", json())).c_str());
    const std::string note = effect.value("note", std::string());
    if (!note.empty()) text += format("%-31s %s\n", "", note.c_str());
  }
  if (plan.contains("effects_bound")) {
    const json& bound = plan["effects_bound"];
    text += "what is off can change reflected light by at most " + short_text(bound.value("mean", json())) +
            " cd/m^2 in the mean and " + short_text(bound.value("max", json())) + " at a pixel\n";
  }
  const json groups = plan.value("light_groups", json::array());
  for (const json& group : groups) {
    if (!group.is_object()) continue;
    text += "light." + group.value("name", std::string("?")) + format(": %.4g lm\n", number(group, "power_lm"));
  }
  if (plan.contains("expected") && is_interval(plan["expected"].value("cpu_s", json()))) {
    const json& cost = plan["expected"];
    text += format("expected cost: %.1f to %.1f CPU s, of which the audit %.1f", cost["cpu_s"][0].get<double>(),
                   cost["cpu_s"][1].get<double>(), number(cost, "audit_cpu_s"));
    text += groups.size() > 1 ? format("; %zu light groups are as many renders\n", groups.size()) : "\n";
    for (const json& other : cost.value("others", json::array())) {
      if (!other.is_object() || !is_interval(other.value("cpu_s", json()))) continue;
      text += format("  %-10s %8.1f to %.1f CPU s\n", other.value("ask", std::string("?")).c_str(),
                     other["cpu_s"][0].get<double>(), other["cpu_s"][1].get<double>());
    }
  }
  return text;
}

std::string closing_table(const json& report) {
  std::string text;
  if (report.contains("stages")) text += stages_table(report["stages"]) + "\n";
  if (report.contains("counts")) text += counts_table(report["counts"]) + "\n";
  if (report.contains("light_groups")) text += light_groups_table(report["light_groups"]) + "\n";
  if (report.contains("effects")) text += effects_lines(report["effects"]);
  if (report.contains("warnings")) {
    for (const json& warning : report["warnings"]) text.append("warning: ").append(short_text(warning)).append("\n");
  }
  return text + accuracy_line(report) + "\n" + rounds_table(report);
}

}  // namespace radfarm::cli
