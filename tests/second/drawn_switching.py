"""Random scenes in the plane that switch: stops, ropes, dry friction, slack springs, blows."""

from typing import Any

from second.drawn import Draw, finished

KINDS = ("stops", "rope", "slide", "axle", "slack", "thrown", "ball", "disks", "carried", "still")


class Switching:
    """One scene as it is drawn."""

    def __init__(self, seed: int) -> None:
        self.draw = Draw(seed)
        self.scene: dict[str, Any] = {"points": {"O": [0, 0], "far": [1.5, 0.4]}, "bodies": {}}
        self.scene |= {"joints": {}, "forces": {}, "contacts": {}, "planes": {}}
        self.initial: dict[str, Any] = {}
        self.events: dict[str, Any] = {}
        self.wanted = ["energy.total", "energy.kinetic", "momentum.x", "momentum.angular"]
        getattr(self, KINDS[seed % len(KINDS)])()

    def bob(self, **start: Any) -> None:
        """A particle, or a disk, that starts somewhere."""
        self.scene["bodies"]["b"] = {"particle": {"mass": self.draw.number(0.5, 2, "kg")}}
        self.initial["b"] = start
        self.wanted += ["b.x", "b.y", "b.vx", "b.vy"]

    def both(self, low: float, high: float, unit: str = "") -> Any:
        """One number for both ways, or one for each."""
        d = self.draw
        one = {way: d.number(low, high, unit) for way in ("forward", "backward")}
        return one if d.chance(0.5) else d.number(low, high, unit)

    def pendulum(self) -> None:
        """A bar on a pin that swings."""
        d = self.draw
        self.scene["bodies"]["b"] = {"bar": {"mass": d.number(0.5, 2, "kg"), "length": 0.6}}
        self.scene["joints"]["j"] = {"pin": ["ground.O", "b.start"]}
        self.initial["j"] = {"angle": d.number(-1.9, -1.2, "rad"), "omega": d.pick(-3.0, 3.0)}
        self.wanted += ["b.angle", "b.omega", "j.fx", "j.fy", "j.angle"]

    def stops(self) -> None:
        """A pendulum between two stops, or with one."""
        d = self.draw
        self.pendulum()
        ends: dict[str, Any] = {"low": d.number(-2.4, -2.1, "rad")}
        ends["high"] = d.number(-1.0, -0.8, "rad")
        if d.chance(0.5):
            ends["restitution"] = d.number(0.2, 1.0)
        self.scene["forces"]["f"] = {"stops": "j"} | ends
        self.wanted += ["f.angle", "f.torque"]

    def rope(self) -> None:
        """A ball on a rope that comes taut, or slackens."""
        d = self.draw
        self.bob(x=d.number(0.2, 0.4), y=d.number(-0.1, 0.2), vx=d.number(1, 2), vy=-0.5)
        self.scene["forces"]["f"] = {"rope": ["ground.O", "b.center"], "length": "55 cm"}
        self.wanted += ["f.length", "f.gap", "f.force"]

    def rail(self, told: dict[str, Any]) -> None:
        """A block on a slide that is pushed."""
        d = self.draw
        self.scene["gravity"] = "none"
        block = {"mass": d.number(0.5, 2, "kg"), "width": 0.3, "height": 0.2}
        self.scene["bodies"]["b"] = {"block": block}
        self.scene["joints"]["j"] = {"slide": ["ground.O", "b.center"], "along": d.direction(2)}
        self.scene["joints"]["j"] |= told
        self.initial["j"] = {"shift": d.number(-0.2, 0.2, "m"), "speed": d.number(-0.4, 0.4)}
        w, F = d.number(20, 30, "rad/s"), d.vector(12.0, 2, "N")
        push = {"amplitude": F, "angular_frequency": w}
        self.scene["forces"]["f"] = {"push": "b.center", "sine": push}
        self.wanted += ["j.shift", "j.speed", "b.x", "f.work"]

    def slide(self) -> None:
        """Dry friction along a slide, which may fall with the speed."""
        d = self.draw
        dry: dict[str, Any] = {"kinetic": self.both(1, 2, "N")}
        if d.chance(0.6):
            dry["static"] = self.both(2, 4, "N")
            if d.chance(0.5):
                dry["stribeck"] = {"speed": d.number(0.05, 0.2, "m/s")}
        self.rail({"dry_friction": dry})
        self.wanted += ["j.slip", "j.friction"]

    def axle(self) -> None:
        """Dry friction about a pin."""
        self.pendulum()
        dry = {"static": self.both(1.0, 1.5, "N m"), "kinetic": self.both(0.3, 0.9, "N m")}
        self.scene["joints"]["j"]["dry_friction"] = dry
        self.wanted += ["j.slip", "j.friction"]

    def still(self) -> None:
        """Viscous friction that comes to rest in a finite time."""
        d = self.draw
        self.rail({})
        del self.scene["forces"]["f"]
        self.initial["j"]["speed"] = d.pick(-0.3, 0.3)
        self.wanted = ["j.shift", "j.speed", "f.speed", "f.force"]
        drag = {"coefficient": self.both(5, 9), "exponent": d.pick(0.5, 0.6)}
        self.scene["forces"]["f"] = {"viscous": "j"} | drag

    def slack(self) -> None:
        """A particle on springs that act on one side."""
        d = self.draw
        self.bob(x=d.number(0.3, 0.6), y=d.number(0.2, 0.6), vx=d.number(-3, 3), vy=d.number(-3, 3))
        for i, only in enumerate(("tension", "compression")):
            ends = ["b.center", d.pick("ground.O", "ground.far")]
            told = {"spring": ends, "stiffness": d.number(50, 150, "N/m"), "only": only}
            self.scene["forces"][f"f{i}"] = told | {"rest_length": d.number(0.5, 1.0, "m")}
            self.wanted += [f"f{i}.length", f"f{i}.force"]

    def thrown(self) -> None:
        """A disk or a particle on the floor, or above it, thrown along."""
        d = self.draw
        self.scene["incline"] = d.number(-0.3, 0.3, "rad")
        mu = d.pick(d.number(0.1, 0.6), {"static": d.number(0.5, 0.6), "kinetic": 0.3})
        touch = {"between": ["b", "ground.floor"], "friction": mu}
        self.bob(x=0, y=0, vx=d.number(-0.5, 0.5))
        if d.chance(0.5):
            self.scene["bodies"]["b"] = {"disk": {"mass": 1.2, "radius": 0.2}}
            self.initial["b"] |= {"y": "20 cm", "angle": 0, "omega": d.number(-5, 5, "rad/s")}
            self.wanted += ["b.angle", "b.omega", "touch.drift"]
        self.scene["contacts"]["touch"] = touch
        self.wanted += [f"touch.{q}" for q in ("normal", "tangent", "slip", "gap")]

    def ball(self) -> None:
        """A disk that strikes a wall with spin."""
        d = self.draw
        self.scene["planes"]["wall"] = {"at": [0.5, 0], "normal": [-2, d.number(-0.5, 0.5)]}
        hit = {"between": ["b", "ground.wall"], "friction": d.number(0.05, 0.5)}
        self.scene["contacts"]["touch"] = hit | {"restitution": d.number(0, 1)}
        self.bob(x=0, y=d.number(0.2, 0.4), vx=d.number(2, 4), vy=d.number(-2, 2))
        self.scene["bodies"]["b"] = {"disk": {"mass": 1.2, "radius": "120 mm"}}
        self.initial["b"] |= {"angle": 0, "omega": d.number(-20, 20, "rad/s")}
        self.wanted += ["b.angle", "b.omega", "touch.slip", "touch.gap"]
        self.events["lands"] = {"touch.gap": "falls to zero"}

    def disks(self) -> None:
        """Two disks, or a particle and a disk, that strike."""
        d = self.draw
        self.scene["gravity"] = "none"
        self.bob(x=0, y=d.number(-0.1, 0.1), vx=d.number(1, 3), vy=d.number(-0.3, 0.3))
        if d.chance(0.6):
            self.scene["bodies"]["b"] = {"disk": {"mass": 0.7, "radius": 0.1}}
            self.initial["b"] |= {"angle": 0, "omega": d.number(-20, 20, "rad/s")}
        self.scene["bodies"]["c"] = {"disk": {"mass": d.number(0.5, 2, "kg"), "radius": 0.15}}
        self.initial["c"] = {"x": 0.35, "y": 0, "angle": 0, "vx": 0, "vy": 0, "omega": 2.0}
        knock = {"between": ["b", "c"], "friction": d.number(0, 0.4)}
        self.scene["contacts"]["touch"] = knock | {"restitution": d.number(0, 1)}
        self.wanted += ["c.x", "c.y", "c.omega", "touch.slip", "touch.gap"]
        self.events["lands"] = {"touch.gap": "falls to zero"}

    def carried(self) -> None:
        """A particle on a block that slides along the floor."""
        d = self.draw
        lower = {"block": {"mass": 2.0, "width": 1.2, "height": 0.2}}
        self.scene["bodies"] |= {"c": lower}
        self.bob(x=d.number(-0.1, 0.1), y=0.2, vx=d.number(-1, 1), vy=0)
        self.initial["c"] = {"x": 0, "y": 0.1, "angle": 0, "vx": d.number(-1, 1), "omega": 0}
        for side in ("left", "right"):
            stand = {"between": [f"c.lower_{side}", "ground.floor"], "friction": 0.2}
            self.scene["contacts"][side] = stand
        top = {"between": ["b", "c.top"], "friction": d.number(0.1, 0.4)}
        self.scene["contacts"]["touch"] = top
        self.wanted += ["c.x", "c.vx", "touch.slip", "touch.normal", "touch.tangent"]


def drawn(seed: int) -> dict[str, Any]:
    """A random case that switches."""
    return finished(Switching(seed), seed)
