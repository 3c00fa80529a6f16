"""Case directories from data: TOML with quantities in a system of units, and tables of stations."""
import json
from dataclasses import dataclass

# What one SI unit is written as: unit and its size in SI, by dimension and system.
SYSTEMS = {
    "SI": {"m": ("m", 1.0), "Pa": ("Pa", 1.0), "N/m": ("N/m", 1.0), "kg/m2": ("kg/m2", 1.0), "N m": ("N m", 1.0), "N": ("N", 1.0)},
    "mm": {"m": ("mm", 1e-3), "Pa": ("kPa", 1e3), "N/m": ("mN/mm", 1.0), "kg/m2": ("g/m2", 1e-3), "N m": ("mN mm", 1e-6),
           "N": ("mN", 1e-3)},
    "inch": {"m": ("inch", 0.0254), "Pa": ("lbf/inch2", 4.4482216152605 / 0.0254**2), "N/m": ("lbf/inch", 4.4482216152605 / 0.0254),
             "kg/m2": ("lb/inch2", 0.45359237 / 0.0254**2), "N m": ("lbf inch", 4.4482216152605 * 0.0254), "N": ("lbf", 4.4482216152605)},
    "cgs": {"m": ("cm", 1e-2), "Pa": ("dyne/cm2", 0.1), "N/m": ("dyne/cm", 1e-3), "kg/m2": ("g/cm2", 10.0), "N m": ("dyne cm", 1e-7),
            "N": ("dyne", 1e-5)},
}


@dataclass(frozen=True)
class Quantity:
    value: float  # SI
    dimension: str

    def text(self, system):
        unit, size = SYSTEMS[system][self.dimension]
        return f"{self.value / size:.17g} {unit}"


def m(value):
    return Quantity(value, "m")


def Pa(value):
    return Quantity(value, "Pa")


def N_m(value):
    return Quantity(value, "N/m")


@dataclass(frozen=True)
class Table:
    """A CSV file of columns: name -> (dimension or "", values in SI)."""
    columns: dict

    def text(self, system):
        unit = {name: SYSTEMS[system][d] if d else ("", 1.0) for name, (d, _) in self.columns.items()}
        head = ", ".join(f"{name} [{unit[name][0]}]" if unit[name][0] else name for name in self.columns)
        rows = zip(*(values for _, values in self.columns.values()))
        lines = [", ".join(f"{v / unit[name][1]:.17g}" for name, v in zip(self.columns, row)) for row in rows]
        return "\n".join([head, *lines]) + "\n"


def toml_value(value, system):
    """A value on one line: tables inline, strings as JSON writes them."""
    if isinstance(value, Quantity):
        return json.dumps(value.text(system))
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml_value(v, system)}" for key, v in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml_value(v, system) for v in value) + "]"
    return json.dumps(value)


def toml_text(case, system="SI"):
    """`case`: section -> table, or a list of tables ([[support]])."""
    lines = []
    for section, content in case.items():
        if not isinstance(content, (dict, list)):
            lines.append(f"{section} = {toml_value(content, system)}")
            continue
        for table in content if isinstance(content, list) else [content]:
            lines.append(f"\n[[{section}]]" if isinstance(content, list) else f"\n[{section}]")
            lines += [f"{key} = {toml_value(value, system)}" for key, value in table.items()]
    return "\n".join(lines) + "\n"


def write_case(folder, title, case, files, system="SI"):
    """case.toml and its files (name -> Table or text) into `folder`."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, content in files.items():
        (folder / name).write_text(content.text(system) if isinstance(content, Table) else content)
    (folder / "case.toml").write_text(toml_text({"title": title, **case}, system))
