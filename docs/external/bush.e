executable: ./light.py
turtle position: P: %g %g %g
