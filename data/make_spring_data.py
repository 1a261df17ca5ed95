"""Write spring_data.csv, the synthetic stand-in for the course's spring_data.mat.

Run from anywhere: ``python data/make_spring_data.py``.
"""

from pathlib import Path

from suspension.springs import synthetic_spring_data

synthetic_spring_data().to_csv(Path(__file__).with_name("spring_data.csv"), index=False)
