"""Random scenes in the plane, of every word that leaves a motion smooth between its corners."""

from typing import Any

from second.drawn import Draw, finished, force

FAR = [[3.1, 2.2], [-2.9, 2.6], [2.7, -3.3]]  # no spring to them comes to nothing


class Plane:
    """One scene as it is drawn: bodies one after the other, each on a joint or free."""

    def __init__(self, seed: int) -> None:
        self.draw = d = Draw(seed)
        self.seed = seed
        self.scene: dict[str, Any] = {"points": {}, "bodies": {}, "joints": {}, "forces": {}}
        self.scene |= {"drive": {}, "constraints": {}}
        self.initial: dict[str, Any] = {}
        self.wanted = ["energy.kinetic", "energy.total", "energy.potential"]
        self.wanted += ["momentum.x", "momentum.y", "momentum.angular"]
        self.turning: list[str] = []  # joints about which something may act
        self.driven: set[str] = set()
        self.heavy()
        self.ground()
        for i in range(int(d.random.integers(1, 4))):
            self.body(i)
        for i in range(int(d.random.integers(1, 4))):
            self.force(f"f{i}")

    def heavy(self) -> None:
        """Gravity in one of its forms."""
        d, s = self.draw, self.scene
        kind = self.seed % 6
        if kind == 1:
            s["gravity"] = "none"
        elif kind == 2:
            s["gravity"] = d.pick("1.62 m/s^2", 3.7)
        elif kind == 3:
            s["gravity"] = d.vector(4.0, 2)
        elif kind == 4:
            s["incline"] = d.number(-0.5, 0.5, "rad")
        elif kind == 5:
            s |= {"incline": d.number(0.1, 0.5, "rad"), "seen": "from above"}

    def ground(self) -> None:
        """Points of the ground, of which some are driven."""
        d, points = self.draw, self.scene["points"]
        points["O"] = [0, 0]
        points["far"] = FAR[self.seed % 3]
        kind = d.pick("still", "velocity", "ramp", "sine", "polynomial")
        at = d.vector(0.3, 2, "m")
        if kind == "still":
            points["Q"] = at
        elif kind == "velocity":
            points["Q"] = {"at": at, "velocity": d.vector(0.5, 2, "m/s")}
        else:
            moves = {
                "ramp": d.vector(0.5, 2),
                "sine": {"amplitude": d.vector(0.1, 2, "m"), "angular_frequency": 7.0},
                "polynomial": {"along": d.direction(2), "coefficients": [0.0, 0.3, -0.5, 0.4]},
            }
            points["Q"] = {"at": at, "moves": {kind: moves[kind]}}

    def shape(self) -> dict[str, Any]:
        """A body of any shape."""
        d = self.draw
        kind = d.pick("bar", "disk", "block", "rigid", "rigid", "particle")
        says = {"mass": d.number(0.5, 2.0, "kg")}
        if kind == "bar":
            says["length"] = d.number(0.4, 1.0, "m")
        elif kind == "disk":
            says["radius"] = d.number(0.2, 0.5, "m")
        elif kind == "block":
            says |= {"width": d.number(0.3, 0.8, "m"), "height": d.number(0.2, 0.6, "m")}
        elif kind == "rigid":
            says["inertia"] = d.number(0.05, 0.3, "kg m²")
        points = {} if kind == "particle" else {"points": {"P": d.vector(0.4, 2, "m")}}
        return {kind: says} | points

    def body(self, i: int) -> None:
        """One more body, and how it hangs on what is there."""
        d, name = self.draw, f"b{i}"
        told = self.shape()
        before = [b for b in self.scene["bodies"] if "particle" not in self.scene["bodies"][b]]
        self.scene["bodies"][name] = told
        point = "center" if "particle" in told else d.pick("P", "center")
        self.wanted += [f"{name}.{q}" for q in ("x", "y", "vx", "vy", "speed", "ax", "ay")]
        if "particle" not in told:
            self.wanted += [f"{name}.{q}" for q in ("angle", "omega", "alpha")]
            self.wanted += [f"{name}.P.{q}" for q in ("x", "y", "vx", "vy", "speed")]
        kinds = ["free", "pin", "slide", "slot", "weld", "distance", "edge"]
        kind = kinds[(self.seed + 3 * i) % 7]
        parent = d.pick("ground.O", "ground.Q", *(f"{b}.P" for b in before[-1:] * 3))
        if "particle" in told and kind in ("pin", "weld", "edge"):
            kind = "slide"
        if kind in ("free", "edge"):
            self.free(name, told, kind)
        elif kind == "distance":
            self.hung(name, told)
        else:
            self.joined(i, kind, parent, f"{name}.{point}", "particle" in told)

    def free(self, name: str, told: dict[str, Any], kind: str) -> None:
        """A body that nothing holds, or an edge alone."""
        d = self.draw
        form = d.pick("center", "point", "polar")
        says: dict[str, Any] = {}
        if form == "polar":
            says |= {"from": "ground.Q", "length": d.number(0.5, 1.0, "m")}
            says["direction"] = d.number(-3, 3, "rad")
        elif form == "point" and "particle" not in told:
            says["P"] = d.vector(1.0, 2, "m")
        else:
            says |= {"x": d.number(-1, 1, "m"), "y": d.number(-1, 1, "m")}
        if "particle" not in told:
            says |= {"angle": d.number(-3, 3, "rad"), "omega": d.number(-3, 3, "rad/s")}
        if kind == "free":
            says |= {"vx": d.number(-1, 1, "m/s"), "vy": d.number(-1, 1, "m/s")}
        else:
            edge = {"edge": f"{name}.P", "along": d.direction(2)}
            if d.chance(0.5):
                edge["speed"] = d.law(0.6, 0, "m/s", jumps=False)
                self.wanted.append("blade.drive")
            else:
                self.initial["blade"] = {"speed": d.number(-1, 1, "m/s")}
            self.scene["constraints"]["blade"] = edge
            self.wanted += [f"blade.{q}" for q in ("force", "slip", "speed")]
        self.initial[name] = says

    def hung(self, name: str, told: dict[str, Any]) -> None:
        """A body at the end of a massless rod, whose length may be that of the start."""
        d = self.draw
        self.scene["joints"]["rod"] = {"distance": ["ground.O", f"{name}.center"]}
        says: dict[str, Any] = {"x": 0.4, "y": -0.3}
        if d.chance(0.5):
            self.scene["joints"]["rod"]["length"] = "500 mm"
            says = {"from": "ground.O", "length": 0.5, "direction": d.number(-2, -1, "rad")}
        says |= {"vx": 0, "vy": 0}
        if "particle" not in told:
            says |= {"angle": d.number(-3, 3, "rad"), "omega": d.number(-3, 3, "rad/s")}
        self.initial[name] = says
        self.wanted += ["rod.force", "rod.gap", "rod.fx", "rod.fy"]

    def joined(self, i: int, kind: str, parent: str, end: str, small: bool) -> None:
        """A body on a pin, a slide, a slot or a weld, of which a rate may be driven."""
        d, name = self.draw, f"j{i}"
        told: dict[str, Any] = {kind: [parent, end]}
        says: dict[str, Any] = {}
        self.wanted += [f"{name}.{q}" for q in ("fx", "fy", "force", "gap")]
        turns, shifts = kind in ("pin", "slot") and not small, kind in ("slide", "slot")
        if shifts:
            told["along"] = d.direction(2)
            says |= {"shift": d.number(-0.3, 0.3, "m"), "speed": d.number(-1, 1, "m/s")}
            self.wanted += [f"{name}.shift", f"{name}.speed"]
        if kind in ("slide", "weld") and not small:
            self.wanted.append(f"{name}.torque")
            if d.chance(0.6):
                told["angle"] = d.number(-2, 2, "rad")
        if turns:
            says |= {"angle": d.number(-3, 3, "rad"), "omega": d.number(-3, 3, "rad/s")}
            self.wanted += [f"{name}.angle", f"{name}.omega"]
            self.turning.append(name)
        rates = [rate for rate in ("speed", "omega") if rate in says]
        if rates and d.chance(0.4):
            rate = d.pick(*rates)
            law = d.law(1.0, 0, "m/s" if rate == "speed" else "rad/s", jumps=False)
            self.scene["drive"][f"{name}.{rate}"] = law
            del says[rate]
            self.driven.add(name)
            self.wanted += [f"{name}.{'drive' if rate == 'speed' else 'torque'}", f"{name}.work"]
        self.scene["joints"][name] = told
        if small and kind == "slide" and parent == "ground.O" and d.chance(0.5):
            says = {"x": 0, "y": 0}
        if says:
            self.initial[f"b{i}" if "x" in says else name] = says

    def force(self, name: str) -> None:
        """A force of any kind that is smooth."""
        told, wanted = force(self.draw, self.scene, self.turning)
        self.scene["forces"][name] = told
        self.wanted += [f"{name}.{q}" for q in wanted]


def drawn(seed: int) -> dict[str, Any]:
    """A random case in the plane."""
    return finished(Plane(seed), seed)
