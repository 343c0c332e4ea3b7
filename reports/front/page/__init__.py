"""The page: one offline HTML file made of the reports' rows and of the motions behind them."""
