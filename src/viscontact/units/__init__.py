"""Units: quantities in words become SI numbers, SI numbers become readable words.

Case files and the command line take ``"5 mm"``; everything behind them is SI. Tables and
figures turn SI numbers back into units a person reads.
"""
