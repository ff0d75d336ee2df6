"""What an FMU says about itself: variables with units, capabilities, identity."""

from __future__ import annotations

import hashlib
import os
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cached_property
from pathlib import Path
from typing import Any

from cardan.archive import open_archive
from cardan.errors import FmuError, InputError

Value = float | int | bool | str


@dataclass(frozen=True, slots=True)
class Variable:
    """One scalar variable of an FMU.

    Attributes
    ----------
    name, type, causality, variability, description : str
        As in the model description; type is ``Real``, ``Integer``, ``Enumeration``, ``Boolean`` or ``String``.
    reference : int
        Value reference.
    unit : str
        Unit text; empty where none is given.
    display_unit : str
        Preferred unit for people; empty where it is `unit` itself.
    display_factor : float
        Value in `display_unit` per value in `unit`.
    start, minimum, maximum : str
        As printed in the model description; empty where not given.
    """

    name: str
    reference: int
    type: str
    causality: str
    variability: str
    unit: str
    display_unit: str
    display_factor: float
    start: str
    minimum: str
    maximum: str
    description: str

    @property
    def call_type(self) -> str:
        """Type in the names of the FMI functions: enumerations are exchanged as Integer."""
        return "Integer" if self.type == "Enumeration" else self.type

    def converted(self, value: Value) -> Value:
        """Return a value as the variable's type wants it.

        Raises
        ------
        InputError
            If it is of another type; the message names variable and value.
        """
        number = isinstance(value, (int, float)) and not isinstance(value, bool)
        kind = self.call_type
        if kind == "Real" and number:
            return float(value)
        if kind == "Integer" and number and float(value).is_integer():
            return int(value)
        if kind == "Boolean" and (isinstance(value, bool) or value in (0, 1)):
            return bool(value)
        if kind == "String" and isinstance(value, str):
            return value
        raise InputError(f"{self.name} = {value!r}: a value of type {self.type} is needed")


@dataclass(frozen=True)
class Description:
    """The model description of an FMI 2.0 co-simulation FMU.

    Attributes
    ----------
    path : pathlib.Path
        The FMU file.
    model_name, identifier, guid, version, generation_tool, generation_date, text : str
        Identity; empty where not given.
    variables : dict of str to Variable
        By name, in the order of the file.
    can_get_set_state, can_serialize_state, variable_step, native : bool
        Capabilities; `native` is False for FMUs that run Python code in the importing process.
    """

    path: Path
    model_name: str
    identifier: str
    guid: str
    version: str
    generation_tool: str
    generation_date: str
    text: str
    variables: dict[str, Variable]
    can_get_set_state: bool
    can_serialize_state: bool
    variable_step: bool
    native: bool

    @cached_property
    def sha256(self) -> str:
        """SHA-256 of the FMU file, hexadecimal."""
        return hashlib.sha256(self.path.read_bytes()).hexdigest()

    def __getitem__(self, name: str) -> Variable:
        """Return the variable of that name.

        Raises
        ------
        InputError
            If there is none; the message gives the nearest names.
        """
        try:
            return self.variables[name]
        except KeyError:
            near = get_close_matches(name, self.variables, 3)
            hint = f"; did you mean {', '.join(near)}?" if near else ""
            raise InputError(f"{self.path.name} has no variable {name!r}{hint}") from None


def read_description(path: str | os.PathLike[str]) -> Description:
    """Read the model description without unpacking the FMU.

    Parameters
    ----------
    path : path-like
        The FMU file.

    Returns
    -------
    Description

    Raises
    ------
    FmuError
        If the file is no FMU, of another FMI version, without co-simulation, or its description is invalid.
    """
    from fmpy import read_model_description

    with open_archive(path) as archive:
        names = archive.namelist()
    try:
        model = read_model_description(str(path))
    except Exception as error:  # FMPy raises all sorts, bare Exception among them
        raise FmuError(f"{path} has no valid modelDescription.xml of FMI 2.0: {_first_lines(error)}") from None
    if model.fmiVersion != "2.0":
        raise FmuError(f"{path} is an FMU of FMI {model.fmiVersion}; only FMI 2.0 is supported")
    if model.coSimulation is None:
        raise FmuError(f"{path} is an FMU for model exchange only; co-simulation is needed")
    capability = model.coSimulation
    return Description(
        path=Path(path),
        model_name=model.modelName or "",
        identifier=capability.modelIdentifier,
        guid=model.guid,
        version=model.version or "",
        generation_tool=model.generationTool or "",
        generation_date=model.generationDateAndTime or "",
        text=model.description or "",
        variables=_variables(model),
        can_get_set_state=bool(capability.canGetAndSetFMUstate),
        can_serialize_state=bool(capability.canSerializeFMUstate),
        variable_step=bool(capability.canHandleVariableCommunicationStepSize),
        native="resources/slavemodule.txt" not in names,
    )


def _variables(model: Any) -> dict[str, Variable]:
    factors = {
        (unit.name, display.name): display.factor for unit in model.unitDefinitions for display in unit.displayUnits
    }
    found = {}
    for entry in model.modelVariables:
        declared = entry.declaredType
        unit = entry.unit or (declared.unit if declared is not None else None) or ""
        display = entry.displayUnit or (declared.displayUnit if declared is not None else None) or ""
        if (unit, display) not in factors:
            display = ""
        found[entry.name] = Variable(
            name=entry.name,
            reference=entry.valueReference,
            type=entry.type,
            causality=entry.causality or "local",
            variability=entry.variability or "continuous",
            unit=unit,
            display_unit=display,
            display_factor=float(factors.get((unit, display), 1.0)),
            start=entry.start or "",
            minimum=entry.min or "",
            maximum=entry.max or "",
            description=entry.description or "",
        )
    return found


def _first_lines(error: Exception) -> str:
    lines = str(error).strip().splitlines()
    return " ".join(lines[:3]) if lines else type(error).__name__
