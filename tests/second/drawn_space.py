"""Random scenes in space, of every word that leaves a motion smooth between its corners."""

from typing import Any

import numpy as np

from second.drawn import Draw, finished, force

FAR = [[3.1, 2.2, 1.0], [-2.9, 2.6, -1.5], [2.7, -3.3, 2.0]]
KINDS = ("hinge", "freedoms", "ball", "universal", "slide", "weld", "free", "blade", "touch")


class Space:
    """One scene as it is drawn: bodies one after the other, each on a joint or free."""

    def __init__(self, seed: int) -> None:
        self.draw = d = Draw(seed)
        self.seed = seed
        self.scene: dict[str, Any] = {"space": 3, "points": {}, "bodies": {}, "joints": {}}
        self.scene |= {"forces": {}, "drive": {}, "constraints": {}, "contacts": {}}
        self.initial: dict[str, Any] = {}
        self.wanted = ["energy.kinetic", "energy.total", "energy.potential"]
        self.wanted += [f"momentum.{q}" for q in ("x", "y", "z", "angular_x", "angular_z")]
        self.turning: list[str] = []
        gravity = seed % 4
        if gravity == 1:
            self.scene["gravity"] = d.pick("none", 3.7, "1.62 m/s^2")
        elif gravity == 2 and KINDS[seed % 9] != "touch":
            self.scene["gravity"] = d.vector(4.0, 3)
        elif gravity == 3:
            self.scene["incline"] = d.number(0.1, 0.4, "rad")
        self.ground()
        for i in range(int(d.random.integers(1, 4)) if KINDS[seed % 9] != "touch" else 1):
            self.body(i)
        for i in range(int(d.random.integers(0, 3)) * (KINDS[seed % 9] != "touch")):
            told, wanted = force(d, self.scene, self.turning)
            self.scene["forces"][f"f{i}"] = told
            self.wanted += [f"f{i}.{q}" for q in wanted]

    def ground(self) -> None:
        """Points of the ground, of which one may be driven."""
        d, points = self.draw, self.scene["points"]
        points["O"] = [0, 0, 0]
        points["far"] = FAR[self.seed % 3]
        at = d.vector(0.3, 3, "m")
        points["Q"] = d.pick(at, {"at": at, "velocity": d.vector(0.5, 3, "m/s")})

    def shape(self, round_one: bool) -> dict[str, Any]:
        """A body of any shape that turns about every axis with some inertia."""
        d = self.draw
        kind = d.pick("disk", "sphere") if round_one else d.pick("disk", "sphere", "block", "rigid")
        says: dict[str, Any] = {"mass": d.number(0.5, 2.0, "kg")}
        if kind in ("disk", "sphere"):
            says["radius"] = d.number(0.2, 0.5, "m")
        if kind == "disk":
            says["axle"] = d.direction(3)
        elif kind == "block":
            says["size"] = [d.number(0.2, 0.6, "m") for _ in range(3)]
        elif kind == "rigid":
            A = d.random.normal(size=(3, 3))
            J = 0.1 * np.eye(3) + 0.02 * (A @ A.T) / np.linalg.norm(A @ A.T)
            says["inertia"] = [
                round(float(J[i, k]), 5)
                for i, k in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
            ]
        return {kind: says, "points": {"P": d.vector(0.4, 3, "m")}}

    def attitude(self) -> Any:
        """One turn, or some in a row."""
        d = self.draw
        turns = [
            {"axis": d.direction(3), "angle": d.number(-2, 2, "rad")}
            for _ in range(int(d.random.integers(1, 4)))
        ]
        return turns[0] if len(turns) == 1 else turns

    def body(self, i: int) -> None:
        """One more body, and how it hangs on what is there."""
        d, name = self.draw, f"b{i}"
        kind = KINDS[(self.seed + 2 * i) % 9]
        if kind in ("touch", "blade") and i:
            kind = "hinge"
        self.scene["bodies"][name] = self.shape(kind == "touch")
        for q in ("x", "y", "z", "vx", "vy", "vz", "speed"):
            self.wanted += [f"{name}.{q}", f"{name}.P.{q}"]
        self.wanted += [f"{name}.attitude", *(f"{name}.omega_{k}" for k in (1, 2, 3))]
        parents = [f"b{i - 1}.P"] * 3 if i else []
        parent = d.pick("ground.O", "ground.Q", *parents)
        if kind in ("free", "blade"):
            self.free(name, kind)
        elif kind == "touch":
            self.rolls(name)
        else:
            if kind == "universal":  # its angles have no names: they start by the body's attitude
                parent = "ground.O"
            self.joined(i, kind, parent, f"{name}.{d.pick('P', 'center')}")

    def free(self, name: str, kind: str) -> None:
        """A body that nothing holds, or one with a blade of kept height."""
        d = self.draw
        says: dict[str, Any] = {"attitude": self.attitude()}
        if d.chance(0.5):
            says["P"] = d.vector(1.0, 3, "m")
        else:
            says |= {axis: d.number(-1, 1, "m") for axis in "xyz"}
        if kind == "free":
            says |= {f"v{axis}": d.number(-1, 1, "m/s") for axis in "xyz"}
            says["omega"] = d.vector(3.0, 3, "rad/s")
        else:
            e = [d.number(0.5, 1), 0, 0]
            says["attitude"] = {"axis": d.direction(3), "angle": d.number(-0.8, 0.8, "rad")}
            says["omega"] = [0, 0, 0]
            told = {"edge": f"{name}.P", "along": e}
            if d.chance(0.6):
                told["height"] = "kept"
                self.wanted += ["blade.normal", "blade.gap"]
            self.scene["constraints"]["blade"] = told
            says |= {"vx": 0, "vy": 0, "vz": 0}
            self.wanted += ["blade.force", "blade.slip", "blade.speed"]
        self.initial[name] = says

    def rolls(self, name: str) -> None:
        """A disk or a sphere that rolls, or a tip that stays where it stands."""
        d = self.draw
        told = {"between": [name, "ground.floor"], "friction": 50.0, "ideal": "rolling"}
        says: dict[str, Any] = {"x": 0.1, "y": d.number(-1, 1, "m")}
        body = self.scene["bodies"][name]
        if d.chance(0.3):
            body.clear()
            body |= {"rigid": {"mass": 1.2, "inertia": [0.02, 0.02, 0.01, 0, 0, 0]}}
            body["points"] = {"P": [0, 0.05, -0.3]}
            told |= {"between": [f"{name}.P", "ground.floor"], "ideal": "pivot"}
            says = {"P": [0.2, d.number(-1, 1, "m"), 0]}
        if "disk" in body:
            body["disk"]["axle"] = [0, 1, 0]
        says["attitude"] = [
            {"axis": [0, 0, 1], "angle": d.number(-2, 2, "rad")},
            {"axis": [1, 0, 0], "angle": d.number(-0.3, 0.3, "rad")},
        ]
        says["omega"] = [d.number(-0.3, 0.3), d.number(2, 3), d.number(-0.5, 0.5)]
        self.scene["contacts"]["touch"] = told
        self.initial[name] = says
        self.wanted += [f"touch.{q}" for q in ("fx", "fy", "normal", "slip", "gap")]
        self.wanted += ["touch.along", "touch.side"] * ("disk" in body)

    def joined(self, i: int, kind: str, parent: str, end: str) -> None:
        """A body on a joint, of which a rate may be driven."""
        d, name = self.draw, f"j{i}"
        told: dict[str, Any] = {kind: [parent, end]}
        says: dict[str, Any] = {}
        self.wanted += [f"{name}.{q}" for q in ("fx", "fy", "fz", "force", "gap")]
        if kind != "ball":
            self.wanted += [f"{name}.{q}" for q in ("mx", "my", "mz", "moment")]
        slides, hinges = self.freedoms(kind, name, told, parent, end)
        for freedom in slides:
            says |= {freedom: d.number(-0.3, 0.3, "m"), f"{freedom}_dot": d.number(-1, 1, "m/s")}
        for freedom in hinges:
            rate = "omega" if freedom == "angle" else f"{freedom}_dot"
            angle = d.number(-1, 1, "rad") if len(hinges) > 1 else d.number(-3, 3, "rad")
            says |= {freedom: angle, rate: d.number(-3, 3, "rad/s")}
            if len(hinges) < 3:
                self.turning.append(name if freedom == "angle" else f"{name}.{freedom}")
        if kind in ("ball", "universal"):
            if kind == "ball":
                says = {"attitude": self.attitude(), "omega": d.vector(3.0, 3, "rad/s")}
                self.initial[name] = says
            else:
                turns = [{"axis": e, "angle": d.number(-1, 1, "rad")} for e in told["axes"]]
                self.initial[f"b{i}"] = {"attitude": turns, "omega": [0, 0, 0]}
        elif says:
            self.wanted += [f"{name}.{q}" for q in says]
            self.drive(name, says, slides)
            self.initial[name] = says
        self.scene["joints"][name] = told

    def freedoms(
        self, kind: str, name: str, told: dict[str, Any], parent: str, end: str
    ) -> tuple[list[str], list[str]]:
        """The names of its slides and hinges, and the words that say them."""
        d = self.draw
        if kind == "hinge":
            told["axis"] = d.direction(3)
            return [], ["angle"]
        if kind == "slide":
            told["along"] = d.direction(3)
            return ["shift"], []
        if kind == "universal":
            told["axes"] = [[0, 0.6, 0.8], [1, 0, 0]]
        if kind == "freedoms":
            s, h = d.pick((1, 1), (0, 2), (2, 1), (1, 2), (3, 0), (3, 2), (0, 3), (0, 1), (3, 3))
            axes = np.linalg.qr(d.random.normal(size=(3, 3)))[0].round(4).tolist()
            says = {f"s{k}": {"slide": axes[k]} for k in range(s)}
            says |= {f"h{k}": {"hinge": axes[(k + 1) % 3]} for k in range(h)}
            told.clear()
            told |= {"freedoms": says, "of": [parent, end]}
            return [f"s{k}" for k in range(s)], [f"h{k}" for k in range(h)]
        return [], []

    def drive(self, name: str, says: dict[str, Any], slides: list[str]) -> None:
        """Perhaps one of its rates is driven, and not given."""
        d = self.draw
        if not d.chance(0.5):
            return
        rate = d.pick(*(q for q in says if q.endswith("_dot") or q == "omega"))
        freedom = "angle" if rate == "omega" else rate.removesuffix("_dot")
        unit = "m/s" if freedom in slides else "rad/s"
        self.scene["drive"][f"{name}.{rate}"] = d.law(1.0, 0, unit, jumps=False)
        del says[rate]
        drives = "torque" if rate == "omega" else f"{freedom}_torque"
        self.wanted += [f"{name}.{f'{freedom}_force' if freedom in slides else drives}"]
        self.wanted.append(f"{name}.work")


def drawn(seed: int) -> dict[str, Any]:
    """A random case in space."""
    return finished(Space(seed), seed)
