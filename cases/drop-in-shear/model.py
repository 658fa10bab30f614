"""The steady drop of Maffettone and Minale (1998) in simple shear, at equal viscosities."""
import math

F1 = 16 / 35  # f1 at viscosity ratio 1; f2 is 1


def shape(capillary):
    """Semi-axes L and B in the plane of shear, in units of the radius at rest, and the angle of L in degrees."""
    a = F1**2 + capillary**2
    b = capillary * math.sqrt(a)
    scale = a ** (1 / 3) * F1 ** (4 / 3)
    return math.sqrt((a + b) / scale), math.sqrt((a - b) / scale), 0.5 * math.degrees(math.atan2(F1, capillary))


def fit_capillary(length, breadth):
    """The capillary number whose L and B come closest to the given ones, by least squares (golden section)."""

    def misfit(capillary):
        model = shape(capillary)
        return (model[0] - length) ** 2 + (model[1] - breadth) ** 2

    ratio = (math.sqrt(5) - 1) / 2
    low, high = 1e-3, 1.0
    for _ in range(80):
        left, right = high - ratio * (high - low), low + ratio * (high - low)
        if misfit(left) < misfit(right):
            high = right
        else:
            low = left
    return (low + high) / 2
