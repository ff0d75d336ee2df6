"""Sketches of signs and zero positions as SVG, drawn from docs/PHYSICS.md section 1."""

from __future__ import annotations

from math import atan2, cos, degrees, hypot, radians, sin

BLUE, RED, GREEN, GREY, LIGHT = "#1f4e79", "#b3402a", "#2f7d4f", "#5b6770", "#c9d3dc"
_BEND = 20.0  # deg, both joints as drawn
Point = tuple[float, float]


def driveline() -> str:
    """Return the driveline from the side, with both joints bent the same way (theta = 0)."""
    rise = radians(_BEND)
    joint1, joint2 = (265.0, 100.0), (665.0, 100.0)
    start = (joint1[0] - 195.0 * cos(rise), joint1[1] + 195.0 * sin(rise))
    end = (joint2[0] + 195.0 * cos(rise), joint2[1] + 195.0 * sin(rise))
    mid1, mid2 = (390.0, 100.0), (545.0, 100.0)
    parts = [
        _line(start, joint1, GREY, 7), _line(joint1, mid1, GREY, 7), _line(mid2, joint2, GREY, 7),
        _line(joint2, end, GREY, 7),
        _line(joint1, _along(joint1, -_BEND, 95.0), GREY, 1, dash=True),
        _line(joint2, _along(joint2, 0.0, 95.0), GREY, 1, dash=True),
        _arc(joint1, 78.0, -_BEND, 0.0, GREEN), _arc(joint2, 78.0, 0.0, _BEND, GREEN),
        _text((joint1[0] + 96.0, joint1[1] - 16.0), "β<tspan dy='4' font-size='11'>1</tspan>", GREEN),
        _text((joint2[0] + 96.0, joint2[1] + 15.0), "β<tspan dy='4' font-size='11'>2</tspan>", GREEN),
        _disc(start, -_BEND, 44.0), _disc(end, _BEND, 56.0),
        _disc(mid1, 0.0, 26.0), _disc(mid2, 0.0, 26.0),
        _spring(mid1, mid2, -11.0), _damper(mid1, mid2, 14.0),
        _cross(joint1, -_BEND / 2), _cross(joint2, _BEND / 2),
        _turn(_along(joint1, 180.0 - _BEND, 95.0), -_BEND, BLUE, forward=True),
        _turn(_along(joint2, _BEND, 128.0), _BEND, RED, forward=False),
        _label((start[0] - 4.0, start[1] + 72.0), "J", "1", "input.inertia"),
        _label((mid1[0] - 18.0, 160.0), "J", "2a", "shaft.inertia_a"),
        _label((mid2[0] + 18.0, 160.0), "J", "2b", "shaft.inertia_b"),
        _label((end[0] - 6.0, end[1] + 84.0), "J", "3", "output.inertia"),
        _text((467.0, 70.0), "k", BLUE, italic=True), _text((467.0, 137.0), "d", BLUE, italic=True),
        _text((joint1[0], joint1[1] - 44.0), "joint 1", BLUE), _text((joint2[0], joint2[1] - 44.0), "joint 2", BLUE),
        _text((joint1[0] - 62.0, joint1[1] + 76.0), "input.torque", BLUE, code=True),
        _text((joint2[0] + 82.0, joint2[1] + 92.0), "output.torque", RED, code=True),
        *_axis(_offset(start, joint1, 60.0, -34.0), -_BEND, "1"), *_axis((443.0, 40.0), 0.0, "2"),
        *_axis(_offset(joint2, end, 95.0, -44.0), _BEND, "3"),
    ]
    return _svg(930, 290, "Driveline from the side: J1, joint 1, J2a, spring and damper, J2b, joint 2, J3", parts)


def joint_dial() -> str:
    """Return a joint against the shaft direction: where its angles are zero and how they count."""
    centre, reach, angle = (150.0, 140.0), 96.0, 35.0
    parts = _planes(centre, "joint plane", "n") + [
        _trunnion(centre, reach, angle, BLUE), _trunnion(centre, reach * 0.82, angle + 90.0, RED),
        _arc(centre, 58.0, 0.0, -angle, BLUE, head=True), _arc(centre, 46.0, -90.0, -90.0 - angle, RED, head=True),
        _text(_polar(centre, 78.0, angle / 2 - 2.0), "φ<tspan dy='4' font-size='11'>in</tspan>", BLUE),
        _text(_polar(centre, 66.0, 90.0 + angle / 2), "φ<tspan dy='4' font-size='11'>out</tspan>", RED),
        _text(_polar(centre, reach + 15.0, angle + 3.0), "a", BLUE, italic=True),
        _text(_polar(centre, reach + 2.0, angle + 92.0), "b", RED, italic=True),
        _eye((32.0, 246.0), "e"),
    ]
    return _svg(300, 275, "Zero positions: the input trunnion in the joint plane, the output trunnion normal to it",
                parts)


def shaft_dial() -> str:
    """Return the intermediate shaft against its direction: yoke phase psi and plane twist theta."""
    centre, reach, twist, trunnion, phase = (150.0, 140.0), 96.0, 28.0, 128.0, 44.0
    normal2 = 90.0 + twist
    parts = [
        _line(_polar(centre, 112.0, 90.0), centre, GREY, 1.5),
        _line(_polar(centre, 112.0, normal2), centre, GREEN, 1.5),
        _text(_polar(centre, 124.0, 90.0), "n<tspan dy='4' font-size='11'>1</tspan>", GREY, italic=True),
        _text(_polar(centre, 125.0, normal2), "n<tspan dy='4' font-size='11'>2</tspan>", GREEN, italic=True),
        _trunnion(centre, reach, trunnion + 22.0, RED), _trunnion(centre, reach, trunnion + 22.0 + phase, BLUE),
        _arc(centre, 84.0, -90.0, -normal2, GREEN, head=True),
        _arc(centre, 62.0, -trunnion - 22.0, -trunnion - 22.0 - phase, BLUE, head=True),
        _text(_polar(centre, 97.0, 90.0 + twist / 2), "θ", GREEN),
        _text(_polar(centre, 77.0, trunnion + 22.0 + phase / 2), "ψ", BLUE),
        _text(_polar(centre, reach + 17.0, trunnion + 20.0), "b<tspan dy='4' font-size='11'>1</tspan>", RED,
              italic=True),
        _text(_polar(centre, reach + 17.0, trunnion + 24.0 + phase), "a<tspan dy='4' font-size='11'>2</tspan>", BLUE,
              italic=True),
        _eye((32.0, 246.0), "e<tspan dy='4' font-size='11'>2</tspan>"),
    ]
    return _svg(300, 275, "Yoke phase psi from joint 1's output trunnion to joint 2's input trunnion; plane twist "
                "theta from normal 1 to normal 2", parts)


def icon() -> str:
    """Return the driveline alone, for the place that an importer gives the FMU in a diagram."""
    left, right = (58.0, 84.0), (142.0, 84.0)
    start, end = _along(left, 180.0 - 2 * _BEND, 48.0), _along(right, 2 * _BEND, 48.0)
    parts = [_line(start, left, GREY, 7), _line(left, right, GREY, 7), _line(right, end, GREY, 7),
             _disc(start, -2 * _BEND, 22.0), _disc(end, 2 * _BEND, 26.0), _cross(left, -_BEND), _cross(right, _BEND)]
    return _svg(200, 200, "CardanDriveline", parts)


def _axis(start: Point, angle: float, index: str) -> list[str]:
    """Unit vector of a shaft."""
    return [_arrow(start, _along(start, angle, 48.0), GREY),
            _text(_along(start, angle, 64.0), f"e<tspan dy='4' font-size='11'>{index}</tspan>", GREY, italic=True)]


def _planes(centre: Point, plane: str, normal: str) -> list[str]:
    x, y = centre
    return [
        f'<rect x="{_n(x - 118)}" y="{_n(y - 5)}" width="236" height="10" fill="{LIGHT}" opacity="0.6"/>',
        _line((x - 118.0, y), (x + 118.0, y), GREY, 1.5), _line((x, y - 112.0), (x, y + 112.0), GREY, 1, dash=True),
        _text((x + 86.0, y + 20.0), plane, GREY), _text((x + 13.0, y - 104.0), normal, GREY, italic=True),
    ]


def _eye(at: Point, name: str) -> str:
    """An axis that points at the reader."""
    x, y = at
    return (f'<circle cx="{_n(x)}" cy="{_n(y)}" r="9" fill="none" stroke="{GREY}" stroke-width="1.5"/>'
            f'<circle cx="{_n(x)}" cy="{_n(y)}" r="2.5" fill="{GREY}"/>'
            + _text((x + 22.0, y + 5.0), name, GREY, italic=True) + _text((x + 84.0, y + 5.0), "points at you", GREY))


def _trunnion(centre: Point, reach: float, angle: float, colour: str) -> str:
    return _line(_polar(centre, reach, angle), _polar(centre, -reach, angle), colour, 6)


def _polar(centre: Point, radius: float, angle: float) -> Point:
    """Point at an angle (deg) that counts against the clock, as the page shows it."""
    return centre[0] + radius * cos(radians(angle)), centre[1] - radius * sin(radians(angle))


def _along(start: Point, angle: float, length: float) -> Point:
    """Point at an angle (deg) that counts with the clock."""
    return _polar(start, length, -angle)


def _offset(start: Point, end: Point, along: float, across: float) -> Point:
    length = hypot(end[0] - start[0], end[1] - start[1])
    x, y = (end[0] - start[0]) / length, (end[1] - start[1]) / length
    return start[0] + along * x - across * y, start[1] + along * y + across * x


def _disc(centre: Point, angle: float, size: float) -> str:
    x, y = centre
    return (f'<rect x="{_n(x - 9)}" y="{_n(y - size)}" width="18" height="{_n(2 * size)}" rx="3" fill="{BLUE}" '
            f'transform="rotate({_n(angle)} {_n(x)} {_n(y)})"/>')


def _cross(centre: Point, angle: float) -> str:
    arms = "".join(_line(_along(centre, angle + turn, 24.0), _along(centre, angle + turn + 180.0, 24.0), BLUE, 6)
                   for turn in (52.0, 128.0))
    x, y = centre
    return arms + f'<circle cx="{_n(x)}" cy="{_n(y)}" r="6" fill="white" stroke="{BLUE}" stroke-width="3"/>'


def _turn(centre: Point, angle: float, colour: str, *, forward: bool) -> str:
    """Direction of turning about a shaft that goes to the right: its near side moves down where it is positive."""
    x, y = centre
    path = "M-9,-22 A15,26 0 0 1 -9,22" if forward else "M-9,22 A15,26 0 0 0 -9,-22"
    tip = (-12.0, 25.0, 138.0) if forward else (-12.0, -25.0, 222.0)
    return (f'<g transform="translate({_n(x)} {_n(y)}) rotate({_n(angle)})"><path d="{path}" fill="none" '
            f'stroke="{colour}" stroke-width="3"/>{_head((tip[0], tip[1]), tip[2], colour)}</g>')


def _spring(start: Point, end: Point, dy: float) -> str:
    x0, x1, y = start[0] + 9.0, end[0] - 9.0, start[1] + dy
    inner0, inner1, count = x0 + 22.0, x1 - 22.0, 8
    points = [(x0, y), (inner0, y)]
    points += [(inner0 + (inner1 - inner0) * (i + 0.5) / count, y + (8.0 if i % 2 else -8.0)) for i in range(count)]
    points += [(inner1, y), (x1, y)]
    text = " ".join(f"{_n(px)},{_n(py)}" for px, py in points)
    return f'<polyline points="{text}" fill="none" stroke="{BLUE}" stroke-width="2.5"/>'


def _damper(start: Point, end: Point, dy: float) -> str:
    x0, x1, y = start[0] + 9.0, end[0] - 9.0, start[1] + dy
    middle = (x0 + x1) / 2
    return (_line((x0, y), (middle - 14.0, y), BLUE, 2.5) + _line((middle + 2.0, y), (x1, y), BLUE, 2.5)
            + f'<path d="M{_n(middle + 14)},{_n(y - 8)} H{_n(middle - 14)} V{_n(y + 8)} H{_n(middle + 14)} '
              f'M{_n(middle + 2)},{_n(y - 6)} V{_n(y + 6)}" fill="none" stroke="{BLUE}" stroke-width="2.5"/>')


def _arc(centre: Point, radius: float, start: float, end: float, colour: str, *, head: bool = False) -> str:
    """Arc between two angles (deg) that count with the clock."""
    (x0, y0), (x1, y1) = _along(centre, start, radius), _along(centre, end, radius)
    sweep = 1 if end > start else 0
    path = (f'<path d="M{_n(x0)},{_n(y0)} A{_n(radius)},{_n(radius)} 0 0 {sweep} {_n(x1)},{_n(y1)}" fill="none" '
            f'stroke="{colour}" stroke-width="2"/>')
    lean = degrees(9.0 / radius / 2)  # the head is a chord of the arc
    turn = end + (90.0 - lean if sweep else -90.0 + lean)
    return path + (_head((x1, y1), turn, colour) if head else "")


def _arrow(start: Point, end: Point, colour: str) -> str:
    return _line(start, end, colour, 2) + _head(end, degrees(atan2(end[1] - start[1], end[0] - start[0])), colour)


def _head(tip: Point, angle: float, colour: str) -> str:
    corners = [tip] + [_along(tip, angle + 180.0 + side, 12.0) for side in (-22.0, 22.0)]
    text = " ".join(f"{_n(x)},{_n(y)}" for x, y in corners)
    return f'<polygon points="{text}" fill="{colour}"/>'


def _line(start: Point, end: Point, colour: str, width: float, *, dash: bool = False) -> str:
    style = ' stroke-dasharray="5 4"' if dash else ' stroke-linecap="round"'
    return (f'<line x1="{_n(start[0])}" y1="{_n(start[1])}" x2="{_n(end[0])}" y2="{_n(end[1])}" stroke="{colour}" '
            f'stroke-width="{_n(width)}"{style}/>')


def _text(at: Point, text: str, colour: str, *, italic: bool = False, code: bool = False) -> str:
    style = ' font-style="italic"' if italic else ""
    family = ' font-family="monospace" font-size="13"' if code else ""
    return (f'<text x="{_n(at[0])}" y="{_n(at[1] + 4.0)}" fill="{colour}" text-anchor="middle"{style}{family}>'
            f"{text}</text>")


def _label(at: Point, symbol: str, index: str, name: str) -> str:
    return (_text(at, f"{symbol}<tspan dy='4' font-size='11'>{index}</tspan>", BLUE)
            + _text((at[0], at[1] + 18.0), name, GREY, code=True))


def _svg(width: int, height: int, title: str, parts: list[str]) -> str:
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" role="img" '
            f'font-family="sans-serif" font-size="15"><title>{title}</title>\n' + "\n".join(parts) + "\n</svg>")


def _n(value: float) -> str:
    """A coordinate, rounded so that it is the same text on every machine."""
    return f"{round(value, 1) + 0.0:g}"
