#!/usr/bin/env python3
"""Writes cie1931_2deg_5nm.csv and d65_5nm.csv (360..830 nm, every 5 nm).

Needs numpy and colour-science (tables checked with colour-science 0.4.7).

* The colour-matching functions are every fifth row of the CIE 1931 2 degree
  standard observer's 1 nm table, unchanged.
* Illuminant D65 is the published 5 nm table up to 780 nm. Above that it is
  computed from the CIE daylight components S0, S1, S2 as CIE 15 defines it,
  with M1 = -0.295 and M2 = -0.689 (the rounded values belonging to D65). The
  script stops if that formula does not give back the published values below
  780 nm.
"""
import os

import colour
import numpy as np
from colour.colorimetry import SDS_BASIS_FUNCTIONS_CIE_ILLUMINANT_D_SERIES as SERIES

HERE = os.path.dirname(os.path.abspath(__file__))
LAMBDA = np.arange(360, 831, 5)


def at(sd, lam):
    """Tabulated values at lam, linear between the points."""
    return np.interp(lam, sd.wavelengths, sd.values)


def main():
    cmf = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
    rows = {int(w): v for w, v in zip(cmf.wavelengths, cmf.values)}
    with open(os.path.join(HERE, "cie1931_2deg_5nm.csv"), "w") as f:
        f.write("lambda_nm,xbar,ybar,zbar\n")
        for w in LAMBDA:
            f.write("%d,%s\n" % (w, ",".join("%.12g" % v for v in rows[int(w)])))

    table = colour.SDS_ILLUMINANTS["D65"]
    s0, s1, s2 = (at(SERIES[k], LAMBDA) for k in ("S0", "S1", "S2"))
    m1, m2 = -0.295, -0.689
    formula = s0 + m1 * s1 + m2 * s2
    published = at(table, LAMBDA)
    inside = LAMBDA <= table.wavelengths.max()
    worst = np.abs(formula - published)[inside].max()
    print("D65: table ends at %g nm; formula against table below: %.2g" % (table.wavelengths.max(), worst))
    assert worst < 5e-3
    d65 = np.where(inside, published, formula)
    with open(os.path.join(HERE, "d65_5nm.csv"), "w") as f:
        f.write("lambda_nm,power\n")
        for w, v in zip(LAMBDA, d65):
            f.write("%d,%.4f\n" % (w, v))


if __name__ == "__main__":
    main()
