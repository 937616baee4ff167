#!/usr/bin/env python3
"""Light among apices: each takes 30 % from every other in a cone of 45 degrees below it."""
import math
import sys

apices = []  # [address, module, place]
for line in sys.stdin:
    words = line.split()
    if words[0] == "P:":  # the turtle's position
        apices[-1][2] = [float(word) for word in words[1:]]
    elif words[0] != "Control:":  # a query: 17 E(1)A
        apices.append([words[0], words[1].split("(")[0], None])
    elif int(words[1]) & 8:  # the run has ended
        break
    else:  # the queries of a step are complete
        for address, module, (x, y, z) in apices:
            above = sum(b - y > math.dist((x, z), (a, c)) for _, _, (a, b, c) in apices)
            print(address, f"{module}({0.7 ** above:.6g})")
        print("Control: 4", flush=True)
        apices.clear()
